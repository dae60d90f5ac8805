// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The drawing that the robot is given.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/grid.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace cmn {

/// A coarse occupancy grid: a downsampled or hand-drawn map of a building (CMN sec. IV-A).
///
/// Cells are free (0) or occupied (1); all that lies outside is occupied. `resolution` [m/cell] is
/// nominal: for a drawing it is a guess, and every method must live with its being wrong.
/// `T_map_grid` is the pose of the grid's lower left corner in the map frame.
class CoarseMap {
 public:
  CoarseMap() = default;
  CoarseMap(Grid<std::uint8_t> occupied, double resolution, Pose2 T_map_grid = {})
      : occupied_{std::move(occupied)}, resolution_{resolution}, T_map_grid_{T_map_grid} {
    for (const std::uint8_t o : occupied_.values()) {
      free_count_ += o == 0;
    }
  }

  int width() const { return occupied_.width(); }
  int height() const { return occupied_.height(); }
  double resolution() const { return resolution_; }
  const Pose2& T_map_grid() const { return T_map_grid_; }
  const Grid<std::uint8_t>& occupied() const { return occupied_; }
  std::size_t free_count() const { return free_count_; }

  bool contains(Cell c) const { return occupied_.contains(c); }
  bool is_free(Cell c) const { return contains(c) && occupied_(c) == 0; }
  bool is_occupied(Cell c) const { return !is_free(c); }

  /// The middle of a cell in the map frame [m].
  Point2 center_of(Cell c) const {
    return T_map_grid_ * Point2{(c.x + 0.5) * resolution_, (c.y + 0.5) * resolution_};
  }
  /// The cell that holds a point of the map frame; may lie outside the map.
  Cell cell_of(Point2 p_map) const {
    const Point2 p = inverse(T_map_grid_) * p_map;
    return {static_cast<int>(std::floor(p.x / resolution_)),
            static_cast<int>(std::floor(p.y / resolution_))};
  }

 private:
  Grid<std::uint8_t> occupied_;
  double resolution_ = 1.0;
  Pose2 T_map_grid_;
  std::size_t free_count_ = 0;
};

/// The same drawing with each cell cut into `cuts` x `cuts`.
CoarseMap cut(const CoarseMap& map, int cuts);

/// The same cells of the same size at the same place.
inline bool is_same_drawing(const CoarseMap& a, const CoarseMap& b) {
  return a.occupied() == b.occupied() && a.resolution() == b.resolution() &&
         a.T_map_grid().x == b.T_map_grid().x && a.T_map_grid().y == b.T_map_grid().y &&
         a.T_map_grid().yaw == b.T_map_grid().yaw;
}

}  // namespace cmn
