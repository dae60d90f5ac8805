// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where a robot carries its sensors.
#pragma once

#include <Eigen/Geometry>

namespace cmn {

/// Poses of the sensors in the robot's frame (base_link: on the floor under the middle of the
/// wheels' axis, x forward, y left, z up). Read from the robot's description (URDF).
struct SensorMounts {
  Eigen::Isometry3d T_robot_lidar = Eigen::Isometry3d::Identity();  ///< beams in its xy plane
  Eigen::Isometry3d T_robot_depth = Eigen::Isometry3d::Identity();  ///< optical frame (REP-103)
  Eigen::Isometry3d T_robot_color = Eigen::Isometry3d::Identity();  ///< optical frame (REP-103)
};

}  // namespace cmn
