// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a LiDAR sends, once TF knows where it was.
#pragma once

#include "coarse_map_nav/perception/range_projection.hpp"
#include "coarse_map_nav/ros/node.hpp"

#include <functional>
#include <optional>

#include <message_filters/subscriber.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Header.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>

namespace cmn {

/// Hears `scan`. Malformed scans, and those without a transform, are dropped with their reason.
class ScanInput {
 public:
  using OnScan = std::function<void(const RangeScan&, const std_msgs::Header&)>;
  /// `needs_odometry`: each scan waits for the odometry of its time.
  ScanInput(ros::NodeHandle& nh, tf2_ros::Buffer& buffer, const FrameParams& frames,
            double timeout_s, bool needs_odometry, OnScan on_scan);

  InputMonitor& monitor() { return monitor_; }

 private:
  void on_message(const sensor_msgs::LaserScan& msg);

  tf2_ros::Buffer& buffer_;
  FrameParams frames_;
  OnScan on_scan_;
  InputMonitor monitor_;
  ros::Subscriber subscriber_;
  message_filters::Subscriber<sensor_msgs::LaserScan> waiting_subscriber_;
  std::optional<tf2_ros::MessageFilter<sensor_msgs::LaserScan>> filter_;
};

}  // namespace cmn
