// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/scan_input.hpp"

#include "coarse_map_nav/ros/conversions.hpp"
#include "coarse_map_nav/ros/tf_lookup.hpp"

#include <string>
#include <utility>

namespace cmn {

ScanInput::ScanInput(ros::NodeHandle& nh, tf2_ros::Buffer& buffer, const FrameParams& frames,
                     double timeout_s, bool needs_odometry, OnScan on_scan)
    : buffer_{buffer}, frames_{frames}, on_scan_{std::move(on_scan)}, monitor_{"scan", timeout_s} {
  if (!needs_odometry) {
    subscriber_ = nh.subscribe("scan", 1, &ScanInput::on_message, this);
    return;
  }
  filter_.emplace(waiting_subscriber_, buffer_, frames_.odom, 5, nh);
  filter_->registerCallback(
      [this](const sensor_msgs::LaserScan::ConstPtr& scan) { on_message(*scan); });
  filter_->registerFailureCallback([this](const sensor_msgs::LaserScan::ConstPtr&, auto) {
    monitor_.dropped("no transform to " + frames_.odom + " at its time");
  });
  waiting_subscriber_.subscribe(nh, "scan", 5);
}

void ScanInput::on_message(const sensor_msgs::LaserScan& msg) {
  std::string why = fault_of(msg);
  if (!why.empty()) {
    monitor_.dropped(why);
    return;
  }
  const std::optional<Pose2> T_robot_sensor =
      lookup(buffer_, frames_.base, msg.header.frame_id, msg.header.stamp, why);
  if (!T_robot_sensor) {
    monitor_.dropped(why);
    return;
  }
  monitor_.received(msg.header.stamp);
  on_scan_(scan_of(msg, *T_robot_sensor), msg.header);
}

}  // namespace cmn
