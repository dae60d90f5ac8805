// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/motion/rest_detector.hpp"

#include <cmath>

namespace cmn {
namespace {

constexpr double kRest_m = 0.001;
constexpr double kRest_rad = 0.1 * kPi / 180.0;

}  // namespace

void RestDetector::update(const OdometrySample& now) {
  newest_s_ = now.stamp_s;
  if (!anchor_ || now.stamp_s < anchor_->stamp_s) {
    anchor_ = now;
    return;
  }
  const Pose2& then = anchor_->T_odom_robot;
  if (norm(now.T_odom_robot.position() - then.position()) > kRest_m ||
      std::abs(wrap_angle(now.T_odom_robot.yaw - then.yaw)) > kRest_rad) {
    anchor_ = now;
  }
}

}  // namespace cmn
