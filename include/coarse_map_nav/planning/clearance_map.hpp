// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How much room there is around the cells of what the robot sees.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/whole_number.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cmn {

/// How far each cell of a local occupancy grid is from what is seen to be occupied: from its middle
/// to the border of the nearest occupied cell.
///
/// Distances are those of a 5 x 5 chamfer mask (Borgefors 1986), to the bit those of OpenCV's
/// distance transform, which does not work on several cells at a time.
class ClearanceMap {
 public:
  /// Beyond `farthest_m` a clearance may come out too large. Cost: O(cells log(farthest)).
  void measure(const LocalOccupancy& local, double farthest_m);
  /// [m], from the robot's frame; kUnseen where nothing was seen.
  double at(Point2 p_robot) const {
    const int ix = column_of(p_robot.x);
    const int iy = column_of(p_robot.y);
    return ix < 0 || iy < 0 || ix >= size_ || iy >= size_ ? kUnseen : at_cell(ix, iy);
  }
  double at_cell(std::size_t i) const {
    return is_seen_[i] != 0 ? static_cast<double>(clearance_m_[i]) : kUnseen;
  }
  double at_cell(int ix, int iy) const {
    return at_cell(static_cast<std::size_t>(iy) * static_cast<std::size_t>(size_) +
                   static_cast<std::size_t>(ix));
  }
  /// What is seen to be occupied is nearer than this, whether or not the cell itself was seen.
  bool is_nearer_than(double distance_m, std::size_t i) const {
    return static_cast<double>(clearance_m_[i]) < distance_m;
  }
  /// The column (and, alike, the row) of a coordinate; may lie outside.
  int column_of(double along_m) const { return whole_below(along_m / resolution_ + 0.5 * size_); }
  int size() const { return size_; }
  static constexpr double kUnseen = -1.0;

 private:
  /// Half of the transform: passes on what the rows before, and the cells before in a row, know.
  /// `sense` 1: from the lowest row up; -1: from the highest down.
  /// Along a row in runs of up to 2^runs - 1 cells.
  void sweep(int sense, int runs);
  float* row_of(int y) {
    return cells_.data() + static_cast<std::ptrdiff_t>(y + 2) * (size_ + 2 * border_) + border_;
  }

  int size_ = 0;
  double resolution_ = 1.0;
  std::vector<float> clearance_m_;
  std::vector<std::uint8_t> is_seen_;
  // Distances to the middle of an occupied cell [cells], between borders of far ones.
  int border_ = 0;
  std::vector<float> cells_;
  std::vector<float> row_;  ///< in the making
  std::vector<float> other_row_;
};

}  // namespace cmn
