// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A straight step along one axis.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/odometry.hpp"
#include "coarse_map_nav/motion/motion_params.hpp"

namespace cmn {

/// Drives `distance_m` from `T_odom_start` along the axis of yaw `axis_yaw_rad` and holds that
/// heading (Robb, "Forward Motion Controller"). It never backs up, as nothing guards its back.
class ForwardController {
 public:
  ForwardController(const MotionParams& params, const Pose2& T_odom_start, double axis_yaw_rad,
                    double distance_m);

  /// What is left to drive along the axis [m]; negative past the end.
  double way_left_m(const Pose2& T_odom_robot) const;
  /// The speeds that profile and heading hold ask for here, not yet ramped.
  VelocityCommand wanted(const Pose2& T_odom_robot) const;

 private:
  MotionParams params_;
  Point2 start_;
  double axis_yaw_rad_;
  double distance_m_;
};

}  // namespace cmn
