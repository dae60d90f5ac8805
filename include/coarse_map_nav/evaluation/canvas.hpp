// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Something to draw on that looks printed.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// Where the point of a text lies that is given for it.
enum class Align { kLeft, kMiddle, kRight };

/// Draws twice as large as wanted and shrinks at the end, which smooths lines and OpenCV's stroked
/// letters. All coordinates and sizes are pixels of the finished picture, fractions allowed.
/// Colours are BGR.
class Canvas {
 public:
  Canvas(cv::Size size, const cv::Scalar& paper);

  void fill(const cv::Rect2d& area, const cv::Scalar& colour);
  void frame(const cv::Rect2d& area, const cv::Scalar& colour, double width = 1.0);
  void polyline(const std::vector<cv::Point2d>& points, const cv::Scalar& colour, double width);
  void polygon(const std::vector<cv::Point2d>& points, const cv::Scalar& colour);
  void disc(cv::Point2d center, double radius, const cv::Scalar& colour);
  /// `at`: on the base line. `height`: of a capital letter.
  void text(const std::string& text, cv::Point2d at, double height, const cv::Scalar& colour,
            Align align = Align::kLeft, bool bold = false);
  /// The same from the left, in smaller letters where it would be wider than `room`.
  void text_within(double room, const std::string& text, cv::Point2d at, double height,
                   const cv::Scalar& colour, bool bold = false);
  /// An 8-bit BGR picture, stretched to `area` with its pixels left square and sharp.
  void picture(const cv::Mat& image, const cv::Rect2d& area);

  /// How wide a text would be.
  static double text_width(const std::string& text, double height, bool bold = false);
  cv::Mat finished() const;

 private:
  cv::Mat image_;
};

/// A colour out of a scale of at least two, evenly spread over [0, 1]; beyond, the last one.
cv::Scalar colour_at(const std::vector<cv::Scalar>& scale, double share);

}  // namespace cmn
