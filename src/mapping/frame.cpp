// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/frame.hpp"

#include "coarse_map_nav/data/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

using Corners = std::array<cv::Point2f, 4>;  // round the quadrilateral

constexpr double kStraight = 0.015;  ///< [of the size] less than a hand draws

struct Line {
  cv::Point2f point;
  cv::Point2f direction;
};

cv::Point2f crossing(const Line& a, const Line& b) {
  const float det = a.direction.cross(b.direction);
  return a.point + (b.point - a.point).cross(b.direction) / det * a.direction;
}

/// Points at even distances along a closed polygon.
std::vector<cv::Point2f> walk_round(const std::vector<cv::Point>& polygon, double step) {
  std::vector<cv::Point2f> points;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const cv::Point2f from = polygon[i];
    const cv::Point2f to = polygon[(i + 1) % polygon.size()];
    const int count = std::max(1, static_cast<int>(cv::norm(to - from) / step));
    for (int k = 0; k < count; ++k) {
      points.push_back(from + static_cast<float>(k) / static_cast<float>(count) * (to - from));
    }
  }
  return points;
}

/// The quadrilateral that the hull of the drawing forms; false when it does not form one.
bool find_quadrilateral(const std::vector<cv::Point>& hull, Corners& corners) {
  const cv::RotatedRect box = cv::minAreaRect(hull);
  Corners sides;
  box.points(sides.data());
  const double size = std::max(box.size.width, box.size.height);
  std::array<std::vector<cv::Point2f>, 4> points;
  for (const cv::Point2f& p : walk_round(hull, size / 400.0)) {
    std::size_t nearest = 0;
    std::array<double, 4> distance{};
    for (std::size_t i = 0; i < 4; ++i) {
      const cv::Point2f along = sides[(i + 1) % 4] - sides[i];
      distance[i] = std::abs(along.cross(p - sides[i])) / cv::norm(along);
      nearest = distance[i] < distance[nearest] ? i : nearest;
    }
    points[nearest].push_back(p);
  }
  std::array<Line, 4> lines;
  for (std::size_t i = 0; i < 4; ++i) {
    if (points[i].size() < 20) {
      return false;
    }
    cv::Vec4f fit;
    cv::fitLine(points[i], fit, cv::DIST_HUBER, 0, 0.01, 0.01);
    lines[i] = {{fit[2], fit[3]}, {fit[0], fit[1]}};
    double error = 0.0;
    for (const cv::Point2f& p : points[i]) {
      error += std::abs(lines[i].direction.cross(p - lines[i].point));
    }
    if (error / static_cast<double>(points[i].size()) > 0.015 * size) {
      return false;
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const double cosine = lines[i].direction.dot(lines[(i + 1) % 4].direction);
    if (std::abs(cosine) > std::sin(20.0 * kPi / 180.0)) {
      return false;
    }
    corners[i] = crossing(lines[(i + 3) % 4], lines[i]);
  }
  return true;
}

/// Whether the sides run along ink: a hull also has sides where the drawing has none, across the
/// notch of an L.
bool runs_along_ink(const Corners& corners, const cv::Mat& ink, double size) {
  cv::Mat distance;
  cv::distanceTransform(255 - ink, distance, cv::DIST_L2, 3);
  for (std::size_t i = 0; i < 4; ++i) {
    constexpr int kSamples = 100;
    int near_ink = 0;
    for (int k = 0; k < kSamples; ++k) {
      const cv::Point p = corners[i] + (k + 0.5F) / kSamples * (corners[(i + 1) % 4] - corners[i]);
      near_ink += cv::Rect({0, 0}, ink.size()).contains(p) && distance.at<float>(p) < 0.02 * size;
    }
    if (near_ink < 0.9 * kSamples) {
      return false;
    }
  }
  return true;
}

/// The corners in the order upper left, upper right, lower right, lower left.
Corners sorted(const Corners& corners) {
  const auto first = std::min_element(corners.begin(), corners.end(),
                                      [](auto a, auto b) { return a.x + a.y < b.x + b.y; });
  Corners result = corners;
  std::rotate(result.begin(), result.begin() + (first - corners.begin()), result.end());
  if ((result[1] - result[0]).cross(result[3] - result[0]) < 0.0F) {
    std::swap(result[1], result[3]);
  }
  return result;
}

/// Warps, and thresholds what the interpolation made grey. The transform keeps the picture's scale.
cv::Mat warped(const cv::Mat& ink, const cv::Matx33d& transform) {
  cv::Mat result;
  cv::warpPerspective(ink, result, transform, ink.size(), cv::INTER_LINEAR);
  return result > 127;
}

}  // namespace

double wall_direction(const cv::Mat& ink) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(ink.clone(), outlines, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  constexpr int kBins = 360;  // a quarter degree each
  std::array<double, kBins> weight{};
  for (const std::vector<cv::Point>& outline : outlines) {
    std::vector<cv::Point> polygon;
    cv::approxPolyDP(outline, polygon, 2.0, true);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const cv::Point d = polygon[(i + 1) % polygon.size()] - polygon[i];
      const double quarters = std::atan2(d.y, d.x) / (kPi / 2.0);
      const double bin = (quarters - std::floor(quarters)) * kBins;
      weight[static_cast<std::size_t>(bin) % kBins] += std::pow(cv::norm(d), 2.0);
    }
  }
  // The heaviest 4 degrees, then the mean within them.
  constexpr int kReach = 8;
  double best = -1.0;
  double direction = 0.0;
  for (int middle = 0; middle < kBins; ++middle) {
    double sum = 0.0;
    double moment = 0.0;
    for (int offset = -kReach; offset <= kReach; ++offset) {
      const double w = weight[static_cast<std::size_t>((middle + offset + kBins) % kBins)];
      sum += w;
      moment += w * offset;
    }
    if (sum > best) {
      best = sum;
      direction = middle + 0.5 + (sum > 0.0 ? moment / sum : 0.0);
    }
  }
  const double angle = direction / kBins * kPi / 2.0;
  return angle > kPi / 4.0 ? angle - kPi / 2.0 : angle;
}

Straightened straighten(const cv::Mat& ink, const cv::Rect& drawing) {
  cv::Mat only = cv::Mat::zeros(ink.size(), CV_8UC1);
  ink(drawing).copyTo(only(drawing));
  std::vector<cv::Point> pixels;
  cv::findNonZero(only, pixels);
  std::vector<cv::Point> hull;
  cv::convexHull(pixels, hull);
  Corners corners;
  const double size = std::hypot(drawing.width, drawing.height);
  if (hull.size() >= 4 && find_quadrilateral(hull, corners) &&
      runs_along_ink(corners, only, size)) {
    const Corners from = sorted(corners);
    const float width =
        static_cast<float>(cv::norm(from[1] - from[0]) + cv::norm(from[2] - from[3])) / 2.0F;
    const float height =
        static_cast<float>(cv::norm(from[3] - from[0]) + cv::norm(from[2] - from[1])) / 2.0F;
    const cv::Point2f middle = 0.25F * (from[0] + from[1] + from[2] + from[3]);
    const cv::Point2f half{width / 2.0F, height / 2.0F};
    const Corners to{middle - half, middle + cv::Point2f{half.x, -half.y}, middle + half,
                     middle + cv::Point2f{-half.x, half.y}};
    double largest = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      largest = std::max(largest, cv::norm(to[i] - from[i]));
    }
    if (largest < kStraight * size) {
      return {ink, "none needed"};
    }
    return {warped(ink, cv::getPerspectiveTransform(from.data(), to.data())), "perspective"};
  }
  const double angle = wall_direction(only);
  if (std::abs(angle) < kPi / 180.0) {
    return {ink, "none needed"};
  }
  const cv::Point2f middle = 0.5F * cv::Point2f(drawing.tl() + drawing.br());
  const cv::Mat rotation = cv::getRotationMatrix2D(middle, angle * 180.0 / kPi, 1.0);
  cv::Matx33d transform = cv::Matx33d::eye();
  cv::Mat(rotation).copyTo(cv::Mat(transform, false).rowRange(0, 2));
  std::array<char, 48> how{};
  std::snprintf(how.data(), how.size(), "rotation by %.1f deg", angle * 180.0 / kPi);
  return {warped(ink, transform), how.data()};
}

}  // namespace cmn
