// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/contact_input.hpp"

#include "coarse_map_nav/ros/tf_lookup.hpp"

#include <string>

namespace cmn {

ContactInput::ContactInput(ros::NodeHandle& nh, tf2_ros::Buffer& buffer, const FrameParams& frames,
                           double radius_m)
    : buffer_{buffer}, frames_{frames}, bumper_{nh}, memory_{radius_m} {}

void ContactInput::mark(LocalOccupancy& local_map) {
  std::string why;
  const auto T_odom_robot = lookup(buffer_, frames_.odom, frames_.base, ros::Time{}, why);
  if (!T_odom_robot) {
    return;  // before the first odometry nothing was driven
  }
  if (bumper_.is_pressed() && !was_pressed_) {
    memory_.add(*T_odom_robot);
  }
  was_pressed_ = bumper_.is_pressed();
  memory_.mark(local_map, *T_odom_robot);
}

}  // namespace cmn
