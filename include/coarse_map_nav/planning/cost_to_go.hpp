// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The length of the shortest way to the goal, from everywhere.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/grid.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace cmn {

/// Dijkstra from the goal over the free cells, four neighbours each: V(c) in cells, infinite where
/// there is no way. Robb's robot moves along the axes only, hence no diagonals.
///
/// All steps cost the same, so Dijkstra's queue is a plain one (breadth first): O(cells), once per
/// goal. Whole numbers up to 2^24 are exact in the float that holds V.
class CostToGo {
 public:
  CostToGo() = default;
  /// `goal` must be free.
  CostToGo(const CoarseMap& map, Cell goal);

  Cell goal() const { return goal_; }
  /// Infinite outside the map, on occupied cells and where there is no way.
  double operator()(Cell c) const;
  bool is_reachable(Cell c) const;
  /// The same between the middles of cells: bilinear among those cells from where there is a way,
  /// infinite where the cell of `p_cells` itself has none. [cells], cell (0, 0) from 0 to 1.
  double between_cells(Point2 p_cells) const;
  /// Where a shortest way leads from `from`. Among equally short ones the one that asks `heading`
  /// to turn least, the left before the right: turning everything turns the answer. Nothing at the
  /// goal and where there is no way.
  std::optional<Heading> next_heading(Cell from, Heading heading) const;
  /// The cells from `from` to the goal, both included, each a neighbour of the one before; among
  /// equally short ways the one that goes on straight, at first along `heading`. Empty when there
  /// is none.
  std::vector<Cell> path(Cell from, Heading heading = Heading::kEast) const;

 private:
  Cell goal_;
  Grid<float> cost_;
};

}  // namespace cmn
