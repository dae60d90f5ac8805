// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How a drawing lies in its picture, and how to lay it straight.
#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace cmn {

/// A drawing laid straight.
struct Straightened {
  cv::Mat ink;      ///< as the input, warped: 255 = ink
  std::string how;  ///< "perspective", "rotation by x deg" or "none needed"
};

/// The angle [rad] in (-pi/4, pi/4], anticlockwise in the picture with y down, by which the walls
/// deviate from the axes: the strongest direction modulo a quarter turn of the ink's outline.
double wall_direction(const cv::Mat& ink);

/// Lays a drawing straight. When the outer walls form a quadrilateral (each side of the convex hull
/// within 1.5 % of a straight line and along ink, corners within 20 deg of a right angle): by the
/// projective map that makes it a rectangle. Otherwise by the rotation that lays the dominant walls
/// along the axes. Nothing is done to a drawing that is straight as a hand draws, to 1.5 % or 1
/// deg. `drawing` is its bounding box; what the warp brings in from beyond the picture is paper.
Straightened straighten(const cv::Mat& ink, const cv::Rect& drawing);

}  // namespace cmn
