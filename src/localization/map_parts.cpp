// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/map_parts.hpp"

#include <algorithm>
#include <cmath>

namespace cmn {
namespace {

int cuts_for(const CoarseMap& drawing, double part_m, double most_parts) {
  int cuts = std::max(1, static_cast<int>(std::ceil(drawing.resolution() / part_m - 1e-6)));
  while (cuts > 1 && static_cast<double>(drawing.free_count()) * cuts * cuts > most_parts) {
    --cuts;
  }
  return cuts;
}

}  // namespace

MapParts::MapParts(const CoarseMap& drawing, double part_m, double most_parts)
    : cuts_{cuts_for(drawing, part_m, most_parts)},
      map_{cut(drawing, cuts_)},
      per_stride_{1.0 / stride()} {}

std::vector<Cell> MapParts::parts_in(Cell cell) const {
  std::vector<Cell> parts;
  for (int y = 0; y < cuts_; ++y) {
    for (int x = 0; x < cuts_; ++x) {
      parts.push_back({cuts_ * cell.x + x, cuts_ * cell.y + y});
    }
  }
  return parts;
}

std::vector<Cell> MapParts::parts_near(Cell cell, double radius_m) const {
  std::vector<Cell> near;
  const Point2 middle = static_cast<double>(cuts_) * middle_of(cell);
  const double radius = radius_m / map_.resolution();
  const int reach = static_cast<int>(std::ceil(radius));
  for (int y = cuts_ * cell.y - reach; y < cuts_ * (cell.y + 1) + reach; ++y) {
    for (int x = cuts_ * cell.x - reach; x < cuts_ * (cell.x + 1) + reach; ++x) {
      const Point2 off = middle_of(Cell{x, y}) - middle;
      if (off.x * off.x + off.y * off.y <= radius * radius && map_.contains({x, y})) {
        near.push_back({x, y});
      }
    }
  }
  return near;
}

}  // namespace cmn
