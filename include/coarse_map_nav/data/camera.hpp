// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Pinhole cameras and what they hand over.
#pragma once

#include <cmath>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

namespace cmn {

/// A pinhole without distortion, as in sensor_msgs/CameraInfo's K.
///
/// Optical frame (REP-103): z forward, x to the right, y down. Pixel (u, v) is column and row; the
/// middle of the upper left pixel is (0, 0). A point at depth z = `depth` [m] along the optical
/// axis lies at x = (u - cx) / fx * z, y = (v - cy) / fy * z.
struct CameraModel {
  int width = 0;              ///< [pixels]
  int height = 0;             ///< [pixels]
  double fx = 0.0, fy = 0.0;  ///< [pixels]
  double cx = 0.0, cy = 0.0;  ///< [pixels]

  /// Square pixels, the axis through the middle of the image.
  static CameraModel from_field_of_view(int width, int height, double horizontal_rad) {
    const double f = 0.5 * width / std::tan(0.5 * horizontal_rad);
    return {width, height, f, f, 0.5 * (width - 1), 0.5 * (height - 1)};
  }
  double horizontal_field_of_view_rad() const {
    return std::atan2(cx + 0.5, fx) + std::atan2(width - 0.5 - cx, fx);
  }
};

/// One colour image and where it was taken from.
struct ColorImage {
  double stamp_s = 0.0;
  CameraModel camera;
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();  ///< base_link <- optical frame
  cv::Mat bgr;                                                       ///< CV_8UC3, height x width
};

/// One depth image and where it was taken from.
struct DepthImage {
  double stamp_s = 0.0;
  CameraModel camera;
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();  ///< base_link <- optical frame
  /// CV_32FC1, height x width, depth along the optical axis [m]; NaN, inf, 0 or less: no reading.
  cv::Mat depth_m;
};

}  // namespace cmn
