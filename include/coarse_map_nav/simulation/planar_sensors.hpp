// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// SceneSensors of a robot in a world without heights: a LiDAR alone.
#pragma once

#include "coarse_map_nav/simulation/range_sensor.hpp"
#include "coarse_map_nav/simulation/scene_sensors.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <cstdint>
#include <stdexcept>

namespace cmn {

class PlanarSensors : public SceneSensors {
 public:
  /// `world` must outlive it.
  PlanarSensors(const World& world, const LidarParams& lidar, std::uint32_t seed)
      : world_{world}, lidar_{lidar, seed} {}

  RangeScan scan(const Pose2& T_world_robot, double stamp_s) override {
    return lidar_.measure(world_, T_world_robot, stamp_s);
  }
  /// Throw std::logic_error: there is nothing that a camera could see.
  DepthImage depth(const Pose2& /*T_world_robot*/, double /*stamp_s*/) override { refuse(); }
  ColorImage color(const Pose2& /*T_world_robot*/, double /*stamp_s*/) override { refuse(); }

 private:
  [[noreturn]] static void refuse() {
    throw std::logic_error("a camera in a world without heights");
  }

  const World& world_;
  RangeSensor lidar_;
};

}  // namespace cmn
