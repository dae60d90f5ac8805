// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/repaired_cost_to_go.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cmn {
namespace {

/// Between neighbours without a wall between them the cost differs by no more, even on a diagonal.
constexpr double kSlope = 2.0;

}  // namespace

RepairedCostToGo::RepairedCostToGo(const RepairedMap& map, Cell goal)
    : goal_{goal},
      cost_{map.width(), map.height(), std::numeric_limits<std::int32_t>::max()},
      towards_{map.width(), map.height()} {
  int dearest = 1;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      dearest = std::max(dearest, map.cost({x, y}));
    }
  }
  std::vector<std::vector<Cell>> buckets(static_cast<std::size_t>(dearest) + 1);
  cost_(goal) = 0;
  buckets[0].push_back(goal);
  std::size_t waiting = 1;
  for (std::int32_t total = 0; waiting > 0; ++total) {
    std::vector<Cell>& bucket = buckets[static_cast<std::size_t>(total) % buckets.size()];
    for (const Cell here : bucket) {
      if (cost_(here) != total) {
        continue;
      }
      // Towards the goal one enters `here`: the price is that of this part, from all its sides.
      const std::int32_t longer = total + map.cost(here);
      for (const Heading h : kHeadings) {
        const Cell c = here + unit_step(h);
        if (cost_.contains(c) && longer < cost_(c)) {
          cost_(c) = longer;
          towards_(c) = turned(h, 2);
          buckets[static_cast<std::size_t>(longer) % buckets.size()].push_back(c);
          ++waiting;
        }
      }
    }
    waiting -= bucket.size();
    bucket.clear();
  }
}

double RepairedCostToGo::between(Point2 p_parts) const {
  const Cell home{static_cast<int>(std::floor(p_parts.x)), static_cast<int>(std::floor(p_parts.y))};
  const double here = (*this)(home);
  const Cell low{static_cast<int>(std::floor(p_parts.x - 0.5)),
                 static_cast<int>(std::floor(p_parts.y - 0.5))};
  double cost = 0.0;
  double weight = 0.0;
  for (const Cell step : {Cell{0, 0}, Cell{1, 0}, Cell{0, 1}, Cell{1, 1}}) {
    const Cell part = low + step;
    const double there = (*this)(part);
    if (std::abs(there - here) <= kSlope) {
      const double share =
          (1.0 - std::abs(p_parts.x - 0.5 - part.x)) * (1.0 - std::abs(p_parts.y - 0.5 - part.y));
      cost += share * there;
      weight += share;
    }
  }
  return cost / weight;  // home is among the four, with a share of 1/4 at the least
}

std::optional<Cell> RepairedCostToGo::next(Cell part) const {
  // Not the neighbour of the least cost: a wall beside costs little once one is in it.
  if (part == goal_ || !cost_.contains(part)) {
    return std::nullopt;
  }
  return part + unit_step(towards_(part));
}

}  // namespace cmn
