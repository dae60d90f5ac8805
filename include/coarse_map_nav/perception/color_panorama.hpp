// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Four colour views around the robot: what CMN predicts local occupancy from.
#pragma once

#include "coarse_map_nav/data/camera.hpp"

#include <array>
#include <cstddef>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

namespace cmn {

constexpr int kViewSide = 80;  ///< [pixels] of a square view (CMN)
constexpr std::size_t kViewCount = 4;

/// Views to the front, left, back and right (CMN's order), so that view k looks along the robot's
/// yaw + k * pi / 2, as Heading counts.
///
/// Each is CV_8UC3, BGR, kViewSide x kViewSide, as a level pinhole with 90 degrees of view sees it:
/// panorama_camera(), its optical axis parallel to the floor, the horizon between rows 39 and 40.
/// The four meet at their borders. What the real camera did not see is black.
struct ColorPanorama {
  double stamp_s = 0.0;
  std::array<cv::Mat, kViewCount> views;

  /// Four black views.
  ColorPanorama();
};

/// The camera of every view: 80 x 80 pixels, f = 40 pixels.
CameraModel panorama_camera();

/// An image of any size as panorama_camera() would have seen it from the same place.
///
/// `R_level_camera` takes directions in the image's optical frame to the level one of the view, as
/// a mount tells it; only what the camera leans, not which way the robot faces. `image`: CV_8UC3 of
/// `camera.width` x `camera.height`. Pixels are averaged before they are thinned out.
cv::Mat level_view(const cv::Mat& image, const CameraModel& camera,
                   const Eigen::Matrix3d& R_level_camera = Eigen::Matrix3d::Identity());

/// Whether the camera looked that way, to the left of where the robot faces: whether the column of
/// pixels there is not all black.
bool is_in_view(const ColorPanorama& panorama, double bearing_rad);

/// The panorama of a robot turned to the left by `quarter_turns` quarter turns at the same place.
ColorPanorama turned(const ColorPanorama& panorama, int quarter_turns);

}  // namespace cmn
