// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/range_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cmn {
namespace {

constexpr double kCodes = 255.0;

/// From the middle of `from` to the border of the next occupied cell [cells], at most `reach`
/// (Amanatides and Woo 1987).
double cast(const CoarseMap& map, Cell from, Point2 ahead, double reach) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double delta_x = ahead.x == 0.0 ? kInfinity : std::abs(1.0 / ahead.x);
  const double delta_y = ahead.y == 0.0 ? kInfinity : std::abs(1.0 / ahead.y);
  double next_x = 0.5 * delta_x;
  double next_y = 0.5 * delta_y;
  Cell c = from;
  while (true) {
    const double way = std::min(next_x, next_y);
    if (way >= reach) {
      return reach;
    }
    if (next_x < next_y) {
      c.x += ahead.x > 0.0 ? 1 : -1;
      next_x += delta_x;
    } else {
      c.y += ahead.y > 0.0 ? 1 : -1;
      next_y += delta_y;
    }
    if (map.is_occupied(c)) {
      return way;
    }
  }
}

bool is_beside_free(const CoarseMap& map, Cell c) {
  return std::any_of(kHeadings.begin(), kHeadings.end(),
                     [&](Heading h) { return map.is_free(c + unit_step(h)); });
}

}  // namespace

double LogRange::step() const { return std::log((longest_m + offset_m) / offset_m) / kCodes; }

double LogRange::exact(double range_m) const {
  return std::log((std::min(range_m, longest_m) + offset_m) / offset_m) / step();
}

std::uint8_t LogRange::coded(double range_m) const {
  return static_cast<std::uint8_t>(std::lround(std::clamp(exact(range_m), 0.0, kCodes)));
}

RangeTable::RangeTable(const CoarseMap& map, const LogRange& code) {
  const auto stride = static_cast<std::size_t>(map.width() + 2);
  row_of_.assign(stride * static_cast<std::size_t>(map.height() + 2), -1);
  std::array<Point2, kBearings> ahead;
  for (int b = 0; b < kBearings; ++b) {
    ahead[static_cast<std::size_t>(b)] = turned(Point2{1.0, 0.0}, bearing_rad(b));
  }
  const double reach = code.longest_m / map.resolution();
  // By far the largest table there is: no larger than it need be, even while it is made.
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < map.occupied().size(); ++i) {
    const Cell c = map.occupied().cell_at(i);
    if (map.is_free(c) || is_beside_free(map, c)) {
      row_of_[static_cast<std::size_t>(c.y + 1) * stride + static_cast<std::size_t>(c.x + 1)] =
          static_cast<std::int32_t>(cells.size());
      cells.push_back(c);
    }
  }
  codes_.reserve(cells.size() * ahead.size());
  for (const Cell c : cells) {
    for (const Point2& direction : ahead) {
      codes_.push_back(code.coded(map.resolution() * cast(map, c, direction, reach)));
    }
  }
}

}  // namespace cmn
