// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a depth camera sends, once TF knows where it was.
#pragma once

#include "coarse_map_nav/perception/perception.hpp"
#include "coarse_map_nav/ros/awaited_messages.hpp"

#include <functional>
#include <optional>

#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>
#include <tf2_ros/buffer.h>

namespace cmn {

/// Hears `points`, and `depth/image` with `camera_info`; a robot sends either. Each message waits
/// for the transforms of its time and is dropped, with its reason, when they do not come or it is
/// malformed.
class DepthInput {
 public:
  /// Gets the image or cloud and the message's header.
  using OnData = std::function<void(const SensorData&, const std_msgs::Header&)>;
  DepthInput(ros::NodeHandle& nh, tf2_ros::Buffer& buffer, const FrameParams& frames,
             double timeout_s, OnData on_data);

  InputMonitor& monitor() { return monitor_; }

 private:
  void on_cloud(const sensor_msgs::PointCloud2& cloud);
  void on_image(const sensor_msgs::Image& image);
  std::optional<Eigen::Isometry3d> mount_of(const std_msgs::Header& header);

  tf2_ros::Buffer& buffer_;
  FrameParams frames_;
  OnData on_data_;
  InputMonitor monitor_;
  std::optional<sensor_msgs::CameraInfo> info_;
  ros::Subscriber info_sub_;
  AwaitedMessages<sensor_msgs::PointCloud2> clouds_;
  AwaitedMessages<sensor_msgs::Image> images_;
};

}  // namespace cmn
