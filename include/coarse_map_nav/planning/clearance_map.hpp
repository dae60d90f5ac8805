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
class ClearanceMap {
 public:
  void measure(const LocalOccupancy& local);
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
  int size_ = 0;
  double resolution_ = 1.0;
  std::vector<float> clearance_m_;
  std::vector<std::uint8_t> is_seen_;
};

}  // namespace cmn
