// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/grid_planner.hpp"

#include "coarse_map_nav/data/grid.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <queue>

namespace cmn {
namespace {

constexpr double kSqrt2 = 1.41421356237309504880;
constexpr double kNoWay = std::numeric_limits<double>::infinity();
/// More than the rounding of a sum of steps, less than the difference between two unequal ones.
constexpr double kEqual = 1e-7;

/// Counter-clockwise from east, an eighth of a turn apart.
constexpr std::array<Cell, 8> kSteps{Cell{1, 0},  Cell{1, 1},   Cell{0, 1},  Cell{-1, 1},
                                     Cell{-1, 0}, Cell{-1, -1}, Cell{0, -1}, Cell{1, -1}};

bool is_diagonal(Cell step) { return step.x != 0 && step.y != 0; }
double length(Cell step) { return is_diagonal(step) ? kSqrt2 : 1.0; }

/// A diagonal needs both cells beside it: a robot has a width.
bool can_step(const CoarseMap& map, Cell from, Cell step) {
  return map.is_free(from + step) && (!is_diagonal(step) || (map.is_free(from + Cell{step.x, 0}) &&
                                                             map.is_free(from + Cell{0, step.y})));
}

double empty_map_cost(Cell offset, Connectivity connectivity) {
  const int dx = std::abs(offset.x);
  const int dy = std::abs(offset.y);
  return connectivity == Connectivity::kFour ? dx + dy
                                             : std::max(dx, dy) + (kSqrt2 - 1.0) * std::min(dx, dy);
}

/// A cell to search from. Of equal totals the one nearer to the end of the search comes first.
struct Entry {
  double total = 0.0;  ///< cost so far plus heuristic
  double cost = 0.0;
  std::size_t cell = 0;
  friend bool operator>(const Entry& a, const Entry& b) {
    return a.total != b.total ? a.total > b.total : a.cost < b.cost;
  }
};

/// Searches from `to`, so that every shortest way can then be walked downhill from `from`.
Grid<double> costs_towards(const CoarseMap& map, Cell from, Cell to, Connectivity connectivity) {
  const std::size_t stride = connectivity == Connectivity::kFour ? 2 : 1;
  Grid<double> cost{map.width(), map.height(), kNoWay};
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost(to) = 0.0;
  open.push({empty_map_cost(from - to, connectivity), 0.0, cost.index_of(to)});
  while (!open.empty() && open.top().total <= cost(from) + kEqual) {
    const Entry entry = open.top();
    open.pop();
    if (entry.cost > cost[entry.cell]) {
      continue;  // a shorter way to this cell was found after it was queued
    }
    const Cell here = cost.cell_at(entry.cell);
    for (std::size_t s = 0; s < kSteps.size(); s += stride) {
      const Cell next = here + kSteps[s];
      const double next_cost = entry.cost + length(kSteps[s]);
      if (can_step(map, here, kSteps[s]) && next_cost < cost(next)) {
        cost(next) = next_cost;
        open.push({next_cost + empty_map_cost(from - next, connectivity), next_cost,
                   cost.index_of(next)});
      }
    }
  }
  return cost;
}

}  // namespace

GridPath shortest_path(const CoarseMap& map, Cell from, Cell to, Connectivity connectivity,
                       Cell direction) {
  GridPath path{{}, kNoWay};
  if (map.is_occupied(from) || map.is_occupied(to)) {
    return path;
  }
  const Grid<double> cost = costs_towards(map, from, to, connectivity);
  path.cost = cost(from);
  if (!std::isfinite(path.cost)) {
    return path;
  }
  const auto turns = connectivity == Connectivity::kFour
                         ? std::vector<std::size_t>{0, 2, 6, 4}
                         : std::vector<std::size_t>{0, 1, 7, 2, 6, 3, 5, 4};
  auto along =
      static_cast<std::size_t>(std::find(kSteps.begin(), kSteps.end(), direction) - kSteps.begin());
  assert(along < kSteps.size() && (connectivity == Connectivity::kEight || along % 2 == 0));
  path.cells.push_back(from);
  while (path.cells.back() != to) {
    const Cell here = path.cells.back();
    for (const std::size_t turn : turns) {
      const Cell step = kSteps[(along + turn) % kSteps.size()];
      if (can_step(map, here, step) && cost(here + step) + length(step) <= cost(here) + kEqual) {
        along = (along + turn) % kSteps.size();
        path.cells.push_back(here + step);
        break;
      }
    }
  }
  return path;
}

}  // namespace cmn
