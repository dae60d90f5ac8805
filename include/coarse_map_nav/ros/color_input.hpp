// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a colour camera sends, once TF knows where it was.
#pragma once

#include "coarse_map_nav/perception/perception.hpp"
#include "coarse_map_nav/ros/awaited_messages.hpp"

#include <functional>
#include <optional>

#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Header.h>

namespace cmn {

/// Hears `image`, of any size and any encoding that has a colour or a brightness, and
/// `image/camera_info`. An image waits for the transforms of its time and is dropped, with its
/// reason, when they do not come or it is malformed.
class ColorInput {
 public:
  /// Gets the image and the message's header.
  using OnImage = std::function<void(const ColorImage&, const std_msgs::Header&)>;
  ColorInput(ros::NodeHandle& nh, tf2_ros::Buffer& buffer, const FrameParams& frames,
             double timeout_s, OnImage on_image);

  InputMonitor& monitor() { return monitor_; }

 private:
  void on_message(const sensor_msgs::Image& image);

  tf2_ros::Buffer& buffer_;
  FrameParams frames_;
  OnImage on_image_;
  InputMonitor monitor_;
  std::optional<sensor_msgs::CameraInfo> info_;
  ros::Subscriber info_sub_;
  AwaitedMessages<sensor_msgs::Image> images_;
};

}  // namespace cmn
