// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a robot's sensors see of a world with heights; the 3D simulator implements it.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

namespace cmn {

/// The sensors of one robot in one scene, at their mounts, with their noise. Each draws from a
/// generator of its own, so that looking with one does not change what another sees.
class SceneSensors {
 public:
  virtual ~SceneSensors() = default;
  /// A sweep of the planar LiDAR at its height.
  virtual RangeScan scan(const Pose2& T_world_robot, double stamp_s) = 0;
  /// Of the depth camera, faults of a RealSense included.
  virtual DepthImage depth(const Pose2& T_world_robot, double stamp_s) = 0;
  /// Of the colour camera.
  virtual ColorImage color(const Pose2& T_world_robot, double stamp_s) = 0;
};

}  // namespace cmn
