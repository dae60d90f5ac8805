// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/bumper.hpp"

#include <array>
#include <string>

#include <ros/serialization.h>
#include <std_msgs/Bool.h>

namespace cmn {
namespace {

/// kobuki_msgs/BumperEvent as released: uint8 bumper (0 to 2), uint8 state (0 released, 1 pressed).
constexpr const char* kKobukiSum = "ffe360cd50f14f9251d9844083e72ac5";

}  // namespace

Bumper::Bumper(ros::NodeHandle& nh)
    : subscriber_{nh.subscribe("bumper", 10, &Bumper::on_message, this)} {}

void Bumper::on_message(const topic_tools::ShapeShifter& message) {
  const std::string& sum = message.getMD5Sum();
  if (sum == ros::message_traits::md5sum<std_msgs::Bool>() && message.size() == 1) {
    pressed_ = message.instantiate<std_msgs::Bool>()->data;
  } else if (sum == kKobukiSum && message.size() == 2) {
    std::array<std::uint8_t, 2> bytes{};
    ros::serialization::OStream stream{bytes.data(), static_cast<std::uint32_t>(bytes.size())};
    message.write(stream);
    const std::uint32_t bit = 1U << (bytes[0] % 32U);
    pressed_ = bytes[1] != 0 ? pressed_ | bit : pressed_ & ~bit;
  } else {
    ROS_WARN_STREAM_THROTTLE(
        5.0, "bumper: dropped, " << message.getDataType() << " is not a known bumper's message");
  }
}

}  // namespace cmn
