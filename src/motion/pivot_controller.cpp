// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/motion/pivot_controller.hpp"

#include "coarse_map_nav/motion/velocity_profile.hpp"

namespace cmn {

PivotController::PivotController(const MotionParams& params, double target_yaw_rad)
    : params_{params}, target_yaw_rad_{target_yaw_rad} {}

double PivotController::way_left_rad(const Pose2& T_odom_robot) const {
  return wrap_angle(target_yaw_rad_ - T_odom_robot.yaw);
}

VelocityCommand PivotController::wanted(const Pose2& T_odom_robot) const {
  const SpeedLimits limits{params_.max_angular_radps, params_.angular_acceleration,
                           params_.approach_gain};
  return {0.0, approach_speed(way_left_rad(T_odom_robot), limits)};
}

}  // namespace cmn
