// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The building that the simulated robot drives in.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/grid.hpp"

#include <optional>
#include <random>

namespace cmn {

/// A metric occupancy grid (usually 5 cm a cell) that can be driven and looked at.
///
/// Occupied cells are solid squares; all that lies outside the grid is occupied, as are unknown
/// cells (read_map() sees to that). Poses and points are those of the world frame, in which the
/// grid may lie anywhere and at any angle.
class World {
 public:
  explicit World(const CoarseMap& map);

  double resolution_m() const { return resolution_m_; }
  bool is_free(Point2 p_world) const { return !nearest_obstacle(p_world, 0.0).has_value(); }
  /// The point of an obstacle that is nearest to `p_world`, when it is nearer than `reach_m`, or
  /// `p_world` itself when that is occupied. Exact.
  std::optional<Point2> nearest_obstacle(Point2 p_world, double reach_m) const;
  /// True when a disc at `center` touches nothing.
  bool is_disc_free(Point2 center, double radius_m) const {
    return !nearest_obstacle(center, radius_m).has_value();
  }
  /// The way from `origin` along the unit vector `direction` to the first obstacle [m], exact;
  /// +inf when it is farther than `reach_m`.
  ///
  /// Steps from cell to cell (Amanatides and Woo 1987) and leaps over what the distance field knows
  /// to be free.
  double cast(Point2 origin, Point2 direction, double reach_m) const;

  /// A place drawn uniformly from the middles of the cells of the largest region that a disc of
  /// radius `clearance_m` can drive in, with a cardinal heading and up to `yaw_error_rad` either
  /// way off it. None when such a disc fits nowhere.
  std::optional<Pose2> random_free_pose(double clearance_m, std::mt19937& rng,
                                        double yaw_error_rad = 0.0) const;

 private:
  /// World frame -> cells of the field, which has a border of one occupied cell.
  Point2 to_field(Point2 p_world) const;
  Point2 to_world(Point2 p_field) const;

  double resolution_m_;
  Pose2 T_world_grid_;
  double cos_yaw_;
  double sin_yaw_;
  /// From the middle of a cell to that of the nearest occupied one [cells]; 0 = occupied.
  Grid<float> distance_;
};

}  // namespace cmn
