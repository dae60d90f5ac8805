// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/ray_cast_sensors.hpp"

#include <random>
#include <utility>

namespace cmn {
namespace {

/// A generator of its own for every sensor.
std::uint32_t seed_of(std::uint32_t seed, std::uint32_t sensor) {
  std::seed_seq sequence{seed, sensor};
  std::uint32_t made = 0;
  sequence.generate(&made, &made + 1);
  return made;
}

}  // namespace

RayCastSensors::RayCastSensors(std::shared_ptr<const RayCaster> caster,
                               const RayCastSensorParams& params, const SensorMounts& mounts,
                               std::uint32_t seed)
    : caster_{std::move(caster)},
      mounts_{mounts},
      lidar_reach_m_{params.lidar.range_max_m},
      lidar_{params.lidar, seed_of(seed, 0)},
      depth_{params.depth, seed_of(seed, 1)},
      color_{params.color, seed_of(seed, 2)} {}

RangeScan RayCastSensors::scan(const Pose2& T_world_robot, double stamp_s) {
  const Eigen::Isometry3d T_world_lidar = in_space(T_world_robot) * mounts_.T_robot_lidar;
  const Eigen::Vector3f origin = T_world_lidar.translation().cast<float>();
  beams_.clear();
  for (const Point2 d : lidar_.directions()) {
    beams_.push_back({origin,
                      (T_world_lidar.linear() * Eigen::Vector3d{d.x, d.y, 0.0}).cast<float>(),
                      static_cast<float>(lidar_reach_m_)});
  }
  caster_->cast(beams_, hits_);
  std::vector<double> ranges_m;
  ranges_m.reserve(hits_.size());
  for (const Hit& hit : hits_) {
    ranges_m.push_back(hit.way);
  }
  return lidar_.read(ranges_m, seen_from_above(mounts_.T_robot_lidar), stamp_s);
}

DepthImage RayCastSensors::depth(const Pose2& T_world_robot, double stamp_s) {
  return {stamp_s, depth_.camera(), mounts_.T_robot_depth,
          depth_.take(*caster_, in_space(T_world_robot) * mounts_.T_robot_depth)};
}

DepthImage RayCastSensors::true_depth(const Pose2& T_world_robot, double stamp_s) {
  return {stamp_s, depth_.camera(), mounts_.T_robot_depth,
          depth_.truth(*caster_, in_space(T_world_robot) * mounts_.T_robot_depth)};
}

ColorImage RayCastSensors::color(const Pose2& T_world_robot, double stamp_s) {
  return {stamp_s, color_.camera(), mounts_.T_robot_color,
          color_.take(*caster_, in_space(T_world_robot) * mounts_.T_robot_color)};
}

}  // namespace cmn
