// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The free space of a fine grid, cut up by coarse cells.
#pragma once

#include "coarse_map_nav/data/grid.hpp"

#include <cstdint>
#include <vector>

namespace cmn {

/// A 4-connected patch of free pixels within the block of one coarse cell.
struct FreePiece {
  Cell cell;
  double share = 0.0;      ///< of the area of its block
  int component = 0;       ///< of the fine grid's free space, 4-connected
  std::vector<int> links;  ///< the pieces in adjacent blocks that it touches, ascending
};

/// All pieces of a fine grid, and the lay of the blocks.
class FreePieces {
 public:
  FreePieces(const Grid<std::uint8_t>& occupied, double pixels_per_cell);

  int width() const { return static_cast<int>(of_cell_.width()); }
  int height() const { return static_cast<int>(of_cell_.height()); }
  int component_count() const { return component_count_; }
  int size() const { return static_cast<int>(pieces_.size()); }
  const FreePiece& operator[](int piece) const { return pieces_[static_cast<std::size_t>(piece)]; }
  /// The pieces of a cell, largest first.
  const std::vector<int>& of(Cell cell) const { return of_cell_(cell); }
  /// The coarse cell of a pixel.
  Cell cell_of(Cell pixel) const {
    return {column_of_[static_cast<std::size_t>(pixel.x)],
            row_of_[static_cast<std::size_t>(pixel.y)]};
  }
  /// Whether a path within the blocks of the two pieces' cells joins them.
  bool joined(int a, int b) const;

 private:
  void cut(const Grid<std::uint8_t>& occupied, double pixels_per_cell);
  void link(const Grid<int>& piece_of);
  void find_components();

  std::vector<int> column_of_;
  std::vector<int> row_of_;
  std::vector<FreePiece> pieces_;
  Grid<std::vector<int>> of_cell_;
  int component_count_ = 0;
};

}  // namespace cmn
