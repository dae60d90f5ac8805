// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The length of the shortest way to the goal, from everywhere.
#pragma once

#include <vector>

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/grid.hpp"

namespace cmn {

/// Dijkstra from the goal over the free cells, four neighbours each: V(c) in cells, infinite where
/// there is no way. Robb's robot moves along the axes only, hence no diagonals.
class CostToGo {
 public:
  CostToGo() = default;
  CostToGo(const CoarseMap& map, Cell goal);

  Cell goal() const { return goal_; }
  double operator()(Cell c) const;
  bool is_reachable(Cell c) const;
  /// The cells from `from` to the goal, both included, each a neighbour of the one before; among
  /// equally short ways the one that goes on straight. Empty when there is none.
  std::vector<Cell> path(Cell from) const;

 private:
  Cell goal_;
  Grid<float> cost_;
};

}  // namespace cmn
