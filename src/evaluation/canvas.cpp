// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/canvas.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr int kEnlarged = 2;
constexpr int kShift = 4;  ///< OpenCV's fixed point: bits of a pixel's fraction
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kCapital = 22.0;  ///< height of a capital letter of the font at scale 1

cv::Point fixed(cv::Point2d p) {
  // OpenCV counts from the middle of a pixel, we from the edge of the picture.
  constexpr double kOne = 1 << kShift;
  return {cvRound((kEnlarged * p.x - 0.5) * kOne), cvRound((kEnlarged * p.y - 0.5) * kOne)};
}
cv::Rect enlarged(const cv::Rect2d& area) {
  return {cv::Point{cvRound(kEnlarged * area.x), cvRound(kEnlarged * area.y)},
          cv::Point{cvRound(kEnlarged * area.br().x), cvRound(kEnlarged * area.br().y)}};
}
int stroke(double width) { return std::max(1, cvRound(kEnlarged * width)); }
std::vector<cv::Point> fixed(const std::vector<cv::Point2d>& points) {
  std::vector<cv::Point> result;
  for (const cv::Point2d p : points) {
    result.push_back(fixed(p));
  }
  return result;
}
int text_stroke(double height, bool bold) { return stroke(height * (bold ? 0.19 : 0.11)); }

}  // namespace

Canvas::Canvas(cv::Size size, const cv::Scalar& paper)
    : image_{kEnlarged * size.height, kEnlarged * size.width, CV_8UC3, paper} {}

void Canvas::fill(const cv::Rect2d& area, const cv::Scalar& colour) {
  image_(enlarged(area) & cv::Rect{{}, image_.size()}).setTo(colour);
}

void Canvas::frame(const cv::Rect2d& area, const cv::Scalar& colour, double width) {
  cv::rectangle(image_, enlarged(area), colour, stroke(width));
}

void Canvas::polyline(const std::vector<cv::Point2d>& points, const cv::Scalar& colour,
                      double width) {
  cv::polylines(image_, fixed(points), false, colour, stroke(width), cv::LINE_AA, kShift);
}

void Canvas::polygon(const std::vector<cv::Point2d>& points, const cv::Scalar& colour) {
  const std::vector<std::vector<cv::Point>> outline{fixed(points)};
  cv::fillPoly(image_, outline, colour, cv::LINE_AA, kShift);
}

void Canvas::disc(cv::Point2d center, double radius, const cv::Scalar& colour) {
  cv::circle(image_, fixed(center), cvRound(kEnlarged * radius * (1 << kShift)), colour, cv::FILLED,
             cv::LINE_AA, kShift);
}

double Canvas::text_width(const std::string& text, double height, bool bold) {
  int base = 0;
  const double scale = kEnlarged * height / kCapital;
  return cv::getTextSize(text, kFont, scale, text_stroke(height, bold), &base).width /
         static_cast<double>(kEnlarged);
}

void Canvas::text(const std::string& text, cv::Point2d at, double height, const cv::Scalar& colour,
                  Align align, bool bold) {
  const double width = text_width(text, height, bold);
  at.x -= align == Align::kLeft ? 0.0 : align == Align::kMiddle ? width / 2.0 : width;
  cv::putText(image_, text, {cvRound(kEnlarged * at.x), cvRound(kEnlarged * at.y)}, kFont,
              kEnlarged * height / kCapital, colour, text_stroke(height, bold), cv::LINE_AA);
}

void Canvas::text_within(double room, const std::string& text, cv::Point2d at, double height,
                         const cv::Scalar& colour, bool bold) {
  const double share = std::min(1.0, room / std::max(1.0, text_width(text, height, bold)));
  this->text(text, at, share * height, colour, Align::kLeft, bold);
}

void Canvas::picture(const cv::Mat& image, const cv::Rect2d& area) {
  const cv::Rect place = enlarged(area);
  cv::Mat stretched;
  const bool grows = place.width >= image.cols;
  cv::resize(image, stretched, place.size(), 0, 0, grows ? cv::INTER_NEAREST : cv::INTER_AREA);
  stretched.copyTo(image_(place));
}

cv::Mat Canvas::finished() const {
  cv::Mat result;
  cv::resize(image_, result, image_.size() / kEnlarged, 0, 0, cv::INTER_AREA);
  return result;
}

cv::Scalar colour_at(const std::vector<cv::Scalar>& scale, double share) {
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(scale.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), scale.size() - 2);
  const double t = at - static_cast<double>(i);
  return (1.0 - t) * scale[i] + t * scale[i + 1];
}

}  // namespace cmn
