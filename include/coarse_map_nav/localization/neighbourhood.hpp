// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// All that a filter step needs to know of a cell.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cmn {

/// A window's bits are looked up so many at a time: a 3 x 3 neighbourhood at once.
constexpr int kPieceBits = 9;
constexpr std::size_t kNeighbourhoods = 512;

/// The bit of the neighbour at offset (dx, dy), each in {-1, 0, 1}; (0, 0) is the cell itself.
constexpr unsigned neighbour_bit(Cell offset) {
  return 1U << static_cast<unsigned>((offset.y + 1) * 3 + offset.x + 1);
}

/// The different surroundings of a map's free cells: what follows from a cell's surroundings alone
/// is computed once for each kind, not for each cell. Of 3 x 3 cells there are fewer than 257
/// kinds; wider windows of a drawing that was blown up are of far fewer kinds than it has cells.
///
/// Cells of a kind have the same n x n window, n = 2 reach + 1, and the same 3 x 3 neighbourhood.
/// Outside of the map all is occupied. Kind 0 stands for all occupied cells, whatever is about
/// them.
struct WindowKinds {
  WindowKinds(const CoarseMap& map, int reach);
  std::size_t size() const { return neighbourhoods.size(); }

  /// The bits of a window, row by row from the lowest, are cut into so many pieces of nine (the
  /// last may have fewer).
  std::size_t pieces;
  std::vector<std::uint16_t> codes;           ///< of each kind `pieces` codes
  std::vector<std::uint16_t> neighbourhoods;  ///< of each kind, bits as of neighbour_bit()
  /// Free cells side by side in a row.
  struct Run {
    Cell first;
    int count;
  };
  std::vector<Run> runs;               ///< of all free cells, row by row
  std::vector<std::uint32_t> of_cell;  ///< the kind of each cell, laid out as in a Belief
};

}  // namespace cmn
