// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a base reports and what it is told.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <cmath>

namespace cmn {

/// A pose in the odometry frame and when it held.
struct OdometrySample {
  double stamp_s = 0.0;
  Pose2 T_odom_robot;
};
inline bool is_finite(const OdometrySample& sample) {
  return std::isfinite(sample.stamp_s) && std::isfinite(sample.T_odom_robot.x) &&
         std::isfinite(sample.T_odom_robot.y) && std::isfinite(sample.T_odom_robot.yaw);
}

struct VelocityCommand {
  double linear_mps = 0.0;     ///< forward
  double angular_radps = 0.0;  ///< left
};

}  // namespace cmn
