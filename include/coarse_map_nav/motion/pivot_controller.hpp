// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A turn on the spot to one yaw.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/odometry.hpp"
#include "coarse_map_nav/motion/motion_params.hpp"

namespace cmn {

/// Turns to `target_yaw_rad` of the odometry frame, the shorter way round.
///
/// Robb ("Better Pivot Controller"): the target is an axis that stays, not the start yaw + pi/2, so
/// that the errors of single pivots do not add up.
class PivotController {
 public:
  PivotController(const MotionParams& params, double target_yaw_rad);

  /// What is left to turn [rad], left positive, in (-pi, pi].
  double way_left_rad(const Pose2& T_odom_robot) const;
  /// The speed that the profile asks for here, not yet ramped.
  VelocityCommand wanted(const Pose2& T_odom_robot) const;

 private:
  MotionParams params_;
  double target_yaw_rad_;
};

}  // namespace cmn
