// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/turned_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cmn {

CoarseMap turned_map(const CoarseMap& map, double turn_rad) {
  constexpr double kRounding = 1e-9;  // [cells]
  // The corners in the new axes, about the old origin [cells].
  Point2 low;
  Point2 high;
  for (const Point2 corner :
       {Point2{static_cast<double>(map.width()), 0.0},
        Point2{0.0, static_cast<double>(map.height())},
        Point2{static_cast<double>(map.width()), static_cast<double>(map.height())}}) {
    const Point2 p = turned(corner, -turn_rad);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  Grid<std::uint8_t> occupied{static_cast<int>(std::ceil(high.x - low.x - kRounding)),
                              static_cast<int>(std::ceil(high.y - low.y - kRounding))};
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    const Point2 p = turned(middle_of(occupied.cell_at(i)) + low, turn_rad);
    const Cell c{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))};
    occupied[i] = map.is_occupied(c) ? 1 : 0;
  }
  const Point2 origin = map.resolution() * turned(low, turn_rad);
  return {std::move(occupied), map.resolution(),
          map.T_map_grid() * Pose2{origin.x, origin.y, turn_rad}};
}

}  // namespace cmn
