// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Line drawings that stay sharp at any size and whose text can be searched.
#pragma once

#include "coarse_map_nav/evaluation/canvas.hpp"

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// How a line is drawn.
struct Stroke {
  std::string colour = "#000000";
  double width = 1.0;
  std::string dash;  ///< "4 2": four on, two off; empty: drawn through
};

/// A picture in SVG 1.1. Coordinates are pixels, x to the right, y down; colours as in CSS.
class Svg {
 public:
  Svg(double width, double height);

  void line(cv::Point2d from, cv::Point2d to, const Stroke& stroke);
  void polyline(const std::vector<cv::Point2d>& points, const Stroke& stroke);
  void fill(const cv::Rect2d& area, const std::string& colour, double opacity = 1.0);
  void disc(cv::Point2d center, double radius, const std::string& colour);
  /// `at`: on the base line. `size`: of the font. `turned_deg`: clockwise about `at`.
  void text(const std::string& text, cv::Point2d at, double size,
            const std::string& colour = "#262c34", Align align = Align::kLeft, bool bold = false,
            double turned_deg = 0.0);

  /// About how wide a text is in a sans serif font, rather too much than too little.
  static double text_width(const std::string& text, double size);
  /// The whole file.
  std::string finished() const;

 private:
  double width_;
  double height_;
  std::string body_;
};

}  // namespace cmn
