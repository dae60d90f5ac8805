// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Images of one colour camera -> the panorama that a network predicts from.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/perception/color_panorama.hpp"
#include "coarse_map_nav/perception/looks_around.hpp"

#include <opencv2/core.hpp>

namespace cmn {

/// Collects a panorama while the robot turns, or makes one of a single image.
///
/// Each image becomes a level view by its mount and calibration. With `turns_round` the views of
/// four headings from one spot make the panorama, each in the place nearest to where it looks from
/// where the robot faces now, and until there are four of them it is not complete. Otherwise an
/// image is the whole of it, in its place, and the other three views are black.
class ColorLooks {
 public:
  explicit ColorLooks(bool turns_round) : turns_round_{turns_round} {}

  /// What is known with the robot at `T_odom_robot`, where the image was taken.
  ColorPanorama add(const ColorImage& image, const Pose2& T_odom_robot);
  void forget() { around_.forget(); }
  bool is_complete() const { return !turns_round_ || around_.is_complete(); }

 private:
  bool turns_round_;
  LooksAround<cv::Mat> around_;
};

}  // namespace cmn
