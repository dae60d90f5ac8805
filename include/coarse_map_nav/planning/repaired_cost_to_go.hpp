// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The price of the cheapest way to the goal on a repaired map, from everywhere.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/grid.hpp"
#include "coarse_map_nav/planning/map_repair.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace cmn {

/// Dijkstra from the goal over the parts of a repaired map, four neighbours each; walls can be
/// crossed at their price, so there is a way from everywhere. O(parts), by Dial's queue.
class RepairedCostToGo {
 public:
  RepairedCostToGo() = default;
  /// `goal` is a part of the map.
  RepairedCostToGo(const RepairedMap& map, Cell goal);

  Cell goal() const { return goal_; }
  /// [steps into free parts]; infinite outside.
  double operator()(Cell part) const {
    return cost_.contains(part) ? static_cast<double>(cost_(part)) : kOutside;
  }
  /// The same between the middles of parts, bilinear among those with no wall in between;
  /// `p_parts`: part (0, 0) from 0 to 1.
  double between(Point2 p_parts) const;
  /// The next part on a cheapest way to the goal; none at the goal and outside.
  std::optional<Cell> next(Cell part) const;

 private:
  static constexpr double kOutside = 1e9;

  Cell goal_;
  Grid<std::int32_t> cost_;
  Grid<Heading> towards_;  ///< to the next part
};

}  // namespace cmn
