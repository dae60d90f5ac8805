// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A* on the coarse map.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cmn {

/// Which cells are one step away.
enum class Connectivity : std::uint8_t {
  kFour,  ///< along the axes, cost 1
  kEight  ///< and along the diagonals, cost sqrt(2), never between or past occupied cells
};

/// A shortest way between two cells.
struct GridPath {
  std::vector<Cell> cells;  ///< both ends included; empty when there is no way
  double cost = 0.0;        ///< [cells]; infinite when there is no way
};

/// A* (Hart, Nilsson, Raphael 1968), the search of CMN sec. IV-D, over the free cells.
///
/// The heuristic is the length of the way on an empty map (Manhattan, octile): admissible and
/// consistent, so the cost is Dijkstra's. All shortest ways are found, and the one is taken that
/// turns least at each step, beginning with `direction` (a neighbour's offset), the left before the
/// right: the result depends neither on the order of the queue nor on how the map is turned.
/// Occupied or outside ends have no way. Cost: O(n log n) in the n cells no farther from both ends
/// together than the way is long.
GridPath shortest_path(const CoarseMap& map, Cell from, Cell to, Connectivity connectivity,
                       Cell direction = {1, 0});

}  // namespace cmn
