// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A robot with all its sensors, in a world of any kind.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/scene/color_camera.hpp"
#include "coarse_map_nav/scene/depth_camera.hpp"
#include "coarse_map_nav/scene/scene_world.hpp"
#include "coarse_map_nav/simulation/scene_sensors.hpp"
#include "coarse_map_nav/simulation/sensor_mounts.hpp"
#include "coarse_map_nav/simulation/simulator.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace cmn {

/// The base and its LiDAR, and the cameras.
struct SimulatedRobotParams : SimulationParams {
  DepthCameraParams depth;
  ColorCameraParams color;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    SimulationParams::visit_params(self, visit);
    visit.group("depth", self.depth);
    visit.group("color", self.color);
  }
};

/// Drives in the world's `body`. In a map the LiDAR sees the map itself, elsewhere the scene at its
/// height; cameras see the scene.
class SimulatedRobot {
 public:
  /// Throws std::invalid_argument when the robot would start inside an obstacle,
  /// std::runtime_error in a build without the 3D simulator, unless the world is a map.
  SimulatedRobot(const SceneWorld& world, const SimulatedRobotParams& params,
                 const SensorMounts& mounts, const Pose2& T_world_start, std::uint32_t seed);

  Simulator& simulator() { return simulator_; }
  RangeScan scan();
  /// Null in a map, in a build without the 3D simulator.
  SceneSensors* cameras() { return sensors_.get(); }
  /// Then this says so.
  const std::string& why_no_cameras() const { return why_no_cameras_; }

 private:
  Simulator simulator_;
  bool is_planar_;
  std::unique_ptr<SceneSensors> sensors_;
  std::string why_no_cameras_;
};

}  // namespace cmn
