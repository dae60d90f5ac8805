// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/simulated_robot.hpp"

#include "coarse_map_nav/scene/ray_cast_sensors.hpp"

#include <stdexcept>

namespace cmn {

SimulatedRobot::SimulatedRobot(const SceneWorld& world, const SimulatedRobotParams& params,
                               const SensorMounts& mounts, const Pose2& T_world_start,
                               std::uint32_t seed)
    : simulator_{World{world.body}, params, T_world_start, seed,
                 seen_from_above(mounts.T_robot_lidar)},
      is_planar_{world.is_map} {
  try {
    sensors_ = std::make_unique<RayCastSensors>(
        make_ray_caster(world.scene), RayCastSensorParams{params.lidar, params.depth, params.color},
        mounts, seed);
  } catch (const std::runtime_error& e) {
    if (!is_planar_) {
      throw;
    }
    why_no_cameras_ = e.what();
  }
}

RangeScan SimulatedRobot::scan() {
  return is_planar_ ? simulator_.scan() : sensors_->scan(simulator_.truth(), simulator_.time_s());
}

}  // namespace cmn
