// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The four images of a panorama side by side, for a person to look at.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <optional>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>

namespace cmn {

/// Four images, each with the yaw that it was taken at, from left to right as the robot that faces
/// `yaw_rad` would see them: left, ahead, right, behind. The last of each heading; nothing where
/// one is missing. All of one type; those of another height are scaled to the first one's.
cv::Mat panorama_of(const std::vector<std::pair<double, cv::Mat>>& images, double yaw_rad);

/// Hears `image` and publishes `panorama`, of colour images where there are any, else of depth
/// images, the nearer the brighter.
class PanoramaStrip {
 public:
  explicit PanoramaStrip(ros::NodeHandle& nh);

  /// A look at rest; `depth_m` may be empty. `is_complete` publishes what has been collected.
  void look(const cv::Mat& depth_m, double yaw_rad, bool is_complete,
            const std_msgs::Header& header);

 private:
  void on_image(const sensor_msgs::Image::ConstPtr& msg);

  std::optional<cv::Mat> colour_;  ///< the newest
  std::vector<std::pair<double, cv::Mat>> images_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
};

}  // namespace cmn
