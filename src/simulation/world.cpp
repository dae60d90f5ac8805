// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/simulation/world.hpp"

#include "coarse_map_nav/data/whole_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Two points of two cells are nearer to each other than the middles by at most this; the tail
/// covers the rounding of the float field.
constexpr double kDiagonal = 1.41421356 + 1e-3;
/// A shorter leap costs more than the steps it saves.
constexpr double kShortestLeap = 2.0;

Cell floor_of(Point2 p) { return {whole_below(p.x), whole_below(p.y)}; }

}  // namespace

World::World(const CoarseMap& map)
    : resolution_m_{map.resolution()},
      T_world_grid_{map.T_map_grid()},
      cos_yaw_{std::cos(T_world_grid_.yaw)},
      sin_yaw_{std::sin(T_world_grid_.yaw)},
      distance_{map.width() + 2, map.height() + 2} {
  cv::Mat free(distance_.height(), distance_.width(), CV_8U, cv::Scalar{0});
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      free.at<std::uint8_t>(y + 1, x + 1) = map.is_free({x, y}) ? 255 : 0;
    }
  }
  cv::Mat distance(distance_.height(), distance_.width(), CV_32F, distance_.values().data());
  cv::distanceTransform(free, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
}

Point2 World::to_field(Point2 p_world) const {
  const double dx = p_world.x - T_world_grid_.x;
  const double dy = p_world.y - T_world_grid_.y;
  return {(cos_yaw_ * dx + sin_yaw_ * dy) / resolution_m_ + 1.0,
          (cos_yaw_ * dy - sin_yaw_ * dx) / resolution_m_ + 1.0};
}

Point2 World::to_world(Point2 p_field) const {
  const double dx = (p_field.x - 1.0) * resolution_m_;
  const double dy = (p_field.y - 1.0) * resolution_m_;
  return {T_world_grid_.x + cos_yaw_ * dx - sin_yaw_ * dy,
          T_world_grid_.y + sin_yaw_ * dx + cos_yaw_ * dy};
}

std::optional<Point2> World::nearest_obstacle(Point2 p_world, double reach_m) const {
  const Point2 p = to_field(p_world);
  const double reach = reach_m / resolution_m_;
  const Cell home = floor_of(p);
  if (!distance_.contains(home) || distance_(home) == 0.0F) {
    return p_world;
  }
  if (distance_(home) - kDiagonal >= reach) {
    return std::nullopt;
  }
  const Cell low = floor_of({p.x - reach, p.y - reach});
  const Cell high = floor_of({p.x + reach, p.y + reach});
  double least = reach * reach;
  std::optional<Point2> nearest;
  for (int y = std::max(0, low.y); y <= std::min(high.y, distance_.height() - 1); ++y) {
    for (int x = std::max(0, low.x); x <= std::min(high.x, distance_.width() - 1); ++x) {
      if (distance_({x, y}) != 0.0F) {
        continue;
      }
      const Point2 q{std::clamp(p.x, double(x), x + 1.0), std::clamp(p.y, double(y), y + 1.0)};
      const double square = (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y);
      if (square < least) {
        least = square;
        nearest = q;
      }
    }
  }
  return nearest ? std::optional<Point2>{to_world(*nearest)} : std::nullopt;
}

double World::cast(Point2 origin, Point2 direction, double reach_m) const {
  const Point2 p = to_field(origin);
  const Point2 d{cos_yaw_ * direction.x + sin_yaw_ * direction.y,
                 cos_yaw_ * direction.y - sin_yaw_ * direction.x};
  Cell cell = floor_of(p);
  if (!distance_.contains(cell)) {
    return 0.0;
  }
  const double reach = reach_m / resolution_m_;
  const int ahead_x = d.x > 0.0 ? 1 : 0;
  const int ahead_y = d.y > 0.0 ? 1 : 0;
  const double inverse_x = 1.0 / d.x;
  const double inverse_y = 1.0 / d.y;
  // The way to the next border between columns and between rows. Along a border it may lie behind:
  // who stands on it (52.0) with the smallest of leanings over it (-1e-17) stays on it, in numbers,
  // however far he goes. Never go back to it: a leap would begin again, for ever.
  const auto next_x = [&] { return d.x == 0.0 ? kInfinity : (cell.x + ahead_x - p.x) * inverse_x; };
  const auto next_y = [&] { return d.y == 0.0 ? kInfinity : (cell.y + ahead_y - p.y) * inverse_y; };

  double way = 0.0;
  double way_x = 0.0;
  double way_y = 0.0;
  bool has_leapt = true;  // way_x and way_y are not yet those of the cell
  while (way <= reach) {
    const double clear = distance_(cell);
    if (clear == 0.0) {
      return way * resolution_m_;
    }
    const double leap = clear - kDiagonal;
    if (leap > kShortestLeap) {
      way += leap;
      cell = floor_of({p.x + way * d.x, p.y + way * d.y});
      has_leapt = true;
      continue;
    }
    if (has_leapt) {
      way_x = next_x();
      way_y = next_y();
      has_leapt = false;
    }
    if (way_x < way_y) {
      way = std::max(way, way_x);  // a leap may land just before a border it had passed
      cell.x += 2 * ahead_x - 1;
      way_x = next_x();
    } else {
      way = std::max(way, way_y);
      cell.y += 2 * ahead_y - 1;
      way_y = next_y();
    }
  }
  return kInfinity;
}

std::optional<Pose2> World::random_free_pose(double clearance_m, std::mt19937& rng,
                                             double yaw_error_rad) const {
  cv::Mat drivable(distance_.height(), distance_.width(), CV_8U, cv::Scalar{0});
  for (std::size_t i = 0; i < distance_.size(); ++i) {
    const Cell c = distance_.cell_at(i);
    drivable.at<std::uint8_t>(c.y, c.x) =
        is_disc_free(to_world({c.x + 0.5, c.y + 0.5}), clearance_m) ? 255 : 0;
  }
  cv::Mat region_of;
  const int regions = cv::connectedComponents(drivable, region_of, 4, CV_32S);
  std::vector<std::vector<Cell>> cells(static_cast<std::size_t>(regions));
  for (std::size_t i = 0; i < distance_.size(); ++i) {
    const Cell c = distance_.cell_at(i);
    const int region = region_of.at<std::int32_t>(c.y, c.x);
    if (region != 0) {
      cells[static_cast<std::size_t>(region)].push_back(c);
    }
  }
  const auto largest = std::max_element(
      cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  if (largest->empty()) {
    return std::nullopt;
  }
  const Cell c =
      (*largest)[std::uniform_int_distribution<std::size_t>{0, largest->size() - 1}(rng)];
  const Point2 p = to_world({c.x + 0.5, c.y + 0.5});
  const int quarter = std::uniform_int_distribution<int>{0, 3}(rng);
  const double error = std::uniform_real_distribution<double>{-1.0, 1.0}(rng)*yaw_error_rad;
  return Pose2{p.x, p.y, wrap_angle(quarter * kPi / 2.0 + error)};
}

}  // namespace cmn
