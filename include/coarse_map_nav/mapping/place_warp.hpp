// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where a point of the metric world lies on a drawing of wrong proportions.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/mapping/places.hpp"

#include <vector>

namespace cmn {

/// A smooth map from the world to the drawing, given by places that are known on both.
///
/// From 6 places on: a thin-plate spline, exact at the places and of the least bending between them
/// (Bookstein 1989, "Principal Warps"). With 3 to 5: the affine map of least squares. It does not
/// extrapolate well, and it knows nothing of walls. For scoring and pictures only: the robot must
/// never see it.
class PlaceWarp {
 public:
  /// Throws std::runtime_error when fewer than 3 places are given, all lie on one line in the
  /// world, or two with different places on the drawing coincide in the world.
  explicit PlaceWarp(const std::vector<Place>& places);

  /// [m] in the world -> [m, nominal] in the map frame of the drawing.
  Point2 world_to_map(Point2 world) const;

 private:
  /// World coordinates moved and scaled to about 1, for the sake of the solver.
  Point2 scaled(Point2 world) const { return (1.0 / scale_) * (world - middle_); }

  Point2 middle_;
  double scale_ = 1.0;
  std::vector<Point2> knots_;  ///< scaled; empty for an affine map
  std::vector<Point2> bend_;   ///< one weight a knot
  Point2 constant_, along_x_, along_y_;
};

}  // namespace cmn
