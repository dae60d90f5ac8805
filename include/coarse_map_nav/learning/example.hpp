// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a predictor learns from: a panorama and what is truly around the robot.
#pragma once

#include "coarse_map_nav/perception/color_panorama.hpp"

#include <array>
#include <cstdint>

#include <opencv2/core.hpp>

namespace cmn {

// Bits of a cell of the truth.
constexpr std::uint8_t kTruthOccupied = 1;
constexpr std::uint8_t kTruthSeen = 2;

/// One pair. The truth is CV_8UC1 of the bits above, row iy and column ix as LocalOccupancy counts
/// cells: rows run to the left, columns forward.
struct Example {
  ColorPanorama panorama;
  cv::Mat near;  ///< kNearSize x kNearSize over kNearSide_m
  cv::Mat wide;  ///< kWideSize x kWideSize over kWideSide_m
  // How it was taken; nothing is learned from these.
  float camera_height_m = 0.0F;
  float tilt_rad = 0.0F;  ///< downwards
  float view_rad = 0.0F;  ///< horizontal field of view

  /// A black panorama, all cells free and not seen.
  Example();
};

/// How thick a solid body is taken to be behind the surface that is in sight [m].
constexpr double kSolid_m = 0.1;

/// Sets kTruthSeen of the cells in sight from the middle of `truth`, and of no other.
///
/// A free cell is in sight when the straight line to its middle meets no occupied cell, and when
/// its bearing lies in one of four views of `view_rad`. An occupied cell is when it lies within
/// kSolid_m of a free one that is. The middle of the grid is where the robot stands: free.
/// Cost: O(size^3).
void mark_seen(cv::Mat& truth, double side_m, double view_rad);

/// The pair that a robot would have seen that is turned to the left by `quarter_turns`.
Example turned(const Example& example, int quarter_turns);
/// The pair of the world's mirror image, left and right exchanged.
Example mirrored(const Example& example);
/// The pair of a robot that has not looked where `is_black`, by view: those views are black, and of
/// the cells that no other view holds none is in sight.
Example blacked_out(const Example& example, const std::array<bool, kViewCount>& is_black);

}  // namespace cmn
