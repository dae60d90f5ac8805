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
/// to the border of the nearest occupied cell, as Borgefors' (1986) 5 x 5 chamfer distance, which
/// is within 2 % of the Euclidean one.
///
/// Few cells lie on the rim of what is occupied, and planning asks for short distances only: each
/// of them stamps its surroundings. Where `most_m` is many cells, two passes over all of them.
class ClearanceMap {
 public:
  /// What is farther than `most_m` counts as infinitely far.
  void measure(const LocalOccupancy& local, double most_m);
  /// [m], from the robot's frame; kUnseen where nothing was seen.
  double at(Point2 p_robot) const {
    const int ix = column_of(p_robot.x);
    const int iy = column_of(p_robot.y);
    return ix < 0 || iy < 0 || ix >= size_ || iy >= size_ ? kUnseen : at_cell(ix, iy);
  }
  double at_cell(std::size_t i) const { return static_cast<double>(clearance_m_[i]); }
  double at_cell(int ix, int iy) const {
    return at_cell(static_cast<std::size_t>(iy) * static_cast<std::size_t>(size_) +
                   static_cast<std::size_t>(ix));
  }
  /// The column (and, alike, the row) of a coordinate; may lie outside.
  int column_of(double along_m) const { return whole_below(along_m / resolution_ + 0.5 * size_); }
  int size() const { return size_; }
  static constexpr double kUnseen = -1.0;

 private:
  /// The ranks of the distances about an occupied cell, row by row.
  struct Stamp {
    double resolution = 0.0;
    double most_m = -1.0;
    int radius = 0;  ///< [cells]
    std::vector<std::uint8_t> ranks;
    std::vector<float> clearance_m;  ///< by rank
  };
  void cut_stamp(double most_m, int radius);
  void find_rim(const LocalOccupancy& local);
  void press_stamps();
  void transform(double most_m);

  int size_ = 0;
  double resolution_ = 1.0;
  std::vector<float> clearance_m_;
  Stamp stamp_;
  std::vector<std::uint8_t> is_occupied_;  ///< with a border of occupied cells; so the next
  std::vector<std::uint8_t> has_occupied_sides_;
  std::vector<std::uint8_t> is_rim_;
  std::vector<std::uint8_t> nearest_;  ///< rank of the least distance, with room for the stamps
};

}  // namespace cmn
