// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Which patch of free space each coarse cell stands for.
#pragma once

#include "coarse_map_nav/data/grid.hpp"
#include "coarse_map_nav/mapping/free_pieces.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace cmn {

/// The choice of one piece, or of none (occupied), for each cell; the steps of coarsen(), in order.
class CellChoice {
 public:
  /// All occupied. Keeps a reference to `pieces`.
  explicit CellChoice(const FreePieces& pieces)
      : pieces_{pieces}, chosen_{pieces.width(), pieces.height(), kOccupied} {}

  /// Free where one piece covers more than half of the cell; one cell for each smaller room.
  void vote();
  /// Occupies cells until no two free neighbours lie on two sides of a wall.
  void keep_walls();
  /// Frees short ways that the drawing has and the cells have not.
  void keep_doors();
  /// Frees ways of any length between rooms that are one in the drawing.
  void join_rooms();
  /// Gives each obstacle that has no cell one, where that cuts no way.
  void keep_obstacles(const Grid<std::uint8_t>& occupied, double pixels_per_cell);
  /// Occupies the few free cells that still have no way to their room.
  void fill_pockets();
  Grid<std::uint8_t> occupied() const;

 private:
  static constexpr int kOccupied = -1;
  using Path = std::vector<int>;  ///< pieces, both ends included

  bool is_free(Cell c) const { return chosen_.contains(c) && chosen_(c) != kOccupied; }
  bool is_chosen(int piece) const { return chosen_(pieces_[piece].cell) == piece; }
  /// The free neighbours of a free cell that are not true to the drawing.
  std::vector<Cell> broken_walls(Cell c) const;
  Path cheapest_path(const std::vector<int>& from, std::size_t longest,
                     const std::vector<int>& barred, const std::function<bool(int)>& is_goal) const;
  /// Cells to go from one free cell to another, or kFar when it is more than `limit`.
  int distance(Cell from, Cell to, int limit) const;
  bool free_path(const Path& path);
  bool cuts_a_way(Cell c) const;
  Grid<int> label_rooms(std::vector<int>& sizes, std::vector<int>& components) const;

  const FreePieces& pieces_;
  Grid<int> chosen_;
};

}  // namespace cmn
