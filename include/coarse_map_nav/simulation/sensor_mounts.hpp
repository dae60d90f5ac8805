// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where a robot carries its sensors.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace cmn {

/// Poses of the sensors in the robot's frame: on the floor under the middle of the wheels' axis, x
/// forward, y left, z up (base_footprint). robot_description.hpp reads them from a URDF.
struct SensorMounts {
  Eigen::Isometry3d T_robot_lidar = Eigen::Isometry3d::Identity();  ///< beams in its xy plane
  Eigen::Isometry3d T_robot_depth = Eigen::Isometry3d::Identity();  ///< optical frame (REP-103)
  Eigen::Isometry3d T_robot_color = Eigen::Isometry3d::Identity();  ///< optical frame (REP-103)
};

/// The pose of an upright frame seen from above.
inline Pose2 seen_from_above(const Eigen::Isometry3d& T_a_b) {
  const Eigen::Vector3d p = T_a_b.translation();
  return {p.x(), p.y(), std::atan2(T_a_b.linear()(1, 0), T_a_b.linear()(0, 0))};
}

}  // namespace cmn
