// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/motion/forward_controller.hpp"

#include "coarse_map_nav/motion/velocity_profile.hpp"

#include <algorithm>

namespace cmn {

ForwardController::ForwardController(const MotionParams& params, const Pose2& T_odom_start,
                                     double axis_yaw_rad, double distance_m)
    : params_{params},
      start_{T_odom_start.position()},
      axis_yaw_rad_{axis_yaw_rad},
      distance_m_{distance_m} {}

double ForwardController::way_left_m(const Pose2& T_odom_robot) const {
  return distance_m_ - turned(T_odom_robot.position() - start_, -axis_yaw_rad_).x;
}

VelocityCommand ForwardController::wanted(const Pose2& T_odom_robot) const {
  const SpeedLimits limits{params_.max_linear_mps, params_.linear_acceleration,
                           params_.approach_gain};
  const double turn_rate = params_.heading_gain * wrap_angle(axis_yaw_rad_ - T_odom_robot.yaw);
  return {approach_speed(std::max(0.0, way_left_m(T_odom_robot)), limits),
          std::clamp(turn_rate, -params_.max_angular_radps, params_.max_angular_radps)};
}

}  // namespace cmn
