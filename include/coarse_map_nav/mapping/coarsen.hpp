// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Fine occupancy -> coarse cells, without closing doors or opening walls.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/grid.hpp"

#include <cstdint>

namespace cmn {

/// Reduces a fine grid to cells of `pixels_per_cell` pixels (>= 1, need not be whole); cell (0, 0)
/// begins at pixel (0, 0), and pixels outside the grid are occupied.
///
/// A plain vote by area loses thin walls and narrow doors. Here each free cell stands for one
/// *piece*: a 4-connected patch of free pixels within the cell's block. Two adjacent free cells are
/// *true* to the drawing when a path within their two blocks joins their pieces.
///
///   1. Passages narrower than `narrowest_passage_cells` are sealed: slips of the pen.
///   2. Vote: a cell is free when one piece covers more than half of it. Each room of a quarter
///   cell
///      or more gets at least one free cell.
///   3. Walls: of two adjacent free cells that are not true, the one with less free area becomes
///      occupied, the worst first. From here on to the end every step between free cells is also
///      possible in the drawing: no wall is open.
///   4. Doors: where the drawing joins two free cells by a short path through occupied ones and the
///      cells have no such way, the path becomes free, and neighbours that it would break into
///      become occupied, unless that cuts another way. The same for free cells that the drawing
///      joins at any distance. So a door survives in a wall, and a gap between two tables too.
///   5. Each obstacle of a quarter cell or more that has no occupied cell left gets one where that
///      cuts no way. Pockets of less than 4 cells that step 4 could not join are filled.
///
/// Step 3 is a guarantee. Step 4 is a repair: two passages closer than a cell to each other may
/// become one. A grid of one pixel a cell is returned as it is. Cost: O(pixels + cells log cells).
/// Throws std::invalid_argument when `pixels_per_cell` is below 1.
Grid<std::uint8_t> coarsen(const Grid<std::uint8_t>& occupied, double pixels_per_cell,
                           double narrowest_passage_cells = 0.3);

/// A map of `cells_wide` cells over the same ground, with the resolution to match. Throws
/// std::invalid_argument when that is more than `fine` has, or less than 1.
CoarseMap coarsen(const CoarseMap& fine, int cells_wide);

}  // namespace cmn
