// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/map_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

using Points = std::vector<cv::Point2d>;

Points placed(const Points& shape, cv::Point2d at, double size, double yaw) {
  Points result;
  for (const cv::Point2d p : shape) {
    result.emplace_back(at.x + size * (std::cos(yaw) * p.x - std::sin(yaw) * p.y),
                        at.y - size * (std::sin(yaw) * p.x + std::cos(yaw) * p.y));
  }
  return result;
}

}  // namespace

MapView view_in(const CoarseMap& map, cv::Point2d corner, cv::Size2d most) {
  const double scale = std::min(most.width / map.width(), most.height / map.height());
  const cv::Size2d size{map.width() * scale, map.height() * scale};
  return {&map, cv::Rect2d{corner.x + (most.width - size.width) / 2.0, corner.y, size.width,
                           size.height}};
}

cv::Mat walls_of(const CoarseMap& map) {
  cv::Mat image(map.height(), map.width(), CV_8UC3, kMapColours.white);
  for (std::size_t i = 0; i < map.occupied().size(); ++i) {
    const Cell c = map.occupied().cell_at(i);
    if (map.is_occupied(c)) {
      image.at<cv::Vec3b>(map.height() - 1 - c.y, c.x) =
          cv::Vec3b(cv::saturate_cast<uchar>(kMapColours.wall[0]),
                    cv::saturate_cast<uchar>(kMapColours.wall[1]),
                    cv::saturate_cast<uchar>(kMapColours.wall[2]));
    }
  }
  return image;
}

cv::Mat walls_of(const CoarseMap& map, double depth_m) {
  cv::Mat is_free(map.height(), map.width(), CV_8UC1);
  for (std::size_t i = 0; i < map.occupied().size(); ++i) {
    const Cell c = map.occupied().cell_at(i);
    is_free.at<uchar>(map.height() - 1 - c.y, c.x) = map.is_free(c) ? 255 : 0;
  }
  const int reach = std::max(1, cvRound(depth_m / map.resolution()));
  cv::Mat is_near;
  cv::dilate(is_free, is_near,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}));
  cv::Mat image = walls_of(map);
  image.setTo(kMapColours.paper, is_near == 0);
  return image;
}

CoarseMap cut_out(const CoarseMap& map, const std::vector<Point2>& points_map, double margin_m) {
  const int margin = std::max(0, static_cast<int>(std::ceil(margin_m / map.resolution())));
  Cell low{map.width(), map.height()};
  Cell high{-1, -1};
  for (const Point2 p : points_map) {
    const Cell c = map.cell_of(p);
    low = {std::min(low.x, c.x - margin), std::min(low.y, c.y - margin)};
    high = {std::max(high.x, c.x + margin), std::max(high.y, c.y + margin)};
  }
  low = {std::max(0, low.x), std::max(0, low.y)};
  high = {std::min(map.width() - 1, high.x), std::min(map.height() - 1, high.y)};
  if (low.x > high.x || low.y > high.y) {
    return map;
  }
  Grid<std::uint8_t> occupied{high.x - low.x + 1, high.y - low.y + 1};
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    occupied[i] = map.occupied()(low + occupied.cell_at(i));
  }
  const Pose2 T_map_part =
      map.T_map_grid() * Pose2{low.x * map.resolution(), low.y * map.resolution(), 0.0};
  return {std::move(occupied), map.resolution(), T_map_part};
}

void draw_goal(Canvas& canvas, cv::Point2d at, double size) {
  Points star;
  for (int i = 0; i < 10; ++i) {
    const double angle = kPi / 2.0 + i * kPi / 5.0;
    const double radius = i % 2 == 0 ? 1.0 : 0.45;
    star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  canvas.polygon(placed(star, at, 1.35 * size, 0.0), kMapColours.white);
  canvas.polygon(placed(star, at, size, 0.0), kMapColours.goal);
}

void draw_estimate(Canvas& canvas, cv::Point2d at, double size, double yaw, bool is_sure) {
  const Points dart{{1.15, 0.0}, {-0.8, 0.75}, {-0.4, 0.0}, {-0.8, -0.75}};
  canvas.polygon(placed(dart, at, 1.2 * size, yaw), kMapColours.white);
  canvas.polygon(placed(dart, at, 0.95 * size, yaw), kMapColours.estimate);
  if (!is_sure) {
    canvas.polygon(placed(dart, at, 0.5 * size, yaw), kMapColours.white);
  }
}

void draw_robot(Canvas& canvas, cv::Point2d at, double size, double yaw) {
  canvas.disc(at, 1.2 * size, kMapColours.white);
  canvas.disc(at, 0.95 * size, kMapColours.truth);
  canvas.polygon(placed({{0.7, 0.0}, {-0.35, 0.45}, {-0.35, -0.45}}, at, size, yaw),
                 kMapColours.white);
}

void draw_start(Canvas& canvas, cv::Point2d at, double size) {
  canvas.disc(at, 1.2 * size, kMapColours.white);
  canvas.disc(at, 0.9 * size, kMapColours.ink);
  canvas.disc(at, 0.5 * size, kMapColours.white);
}

}  // namespace cmn
