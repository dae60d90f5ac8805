// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How a drawing is out of proportion: a smooth map of the plane onto itself.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <random>
#include <utility>
#include <vector>

namespace cmn {

/// The derivative of a map of the plane; row by row.
struct Jacobian2 {
  double xx = 1.0, xy = 0.0;
  double yx = 0.0, yy = 1.0;

  double determinant() const { return xx * yy - xy * yx; }
  /// The least and the greatest stretch of any direction.
  std::pair<double, double> stretches() const;
  /// The rotation nearest to it (its polar factor) [rad].
  double rotation() const;
};

/// p -> p + a sum of plane waves.
///
/// The derivative of the sum is nowhere longer than a bound below 1, so the map is invertible on
/// the whole plane (Banach's fixed-point theorem) and keeps its orientation.
class SmoothWarp {
 public:
  struct Wave {
    Point2 per_metre;  ///< [rad/m] how the phase grows
    Point2 shift_m;    ///< amplitude
    double phase = 0.0;
  };

  /// The identity.
  SmoothWarp() = default;
  /// Throws std::invalid_argument when the waves could add up to a slope of 0.95 or more.
  explicit SmoothWarp(std::vector<Wave> waves);

  /// The same waves, all `factor` times as high.
  SmoothWarp scaled(double factor) const;

  Point2 operator()(Point2 p) const;
  Jacobian2 jacobian(Point2 p) const;
  /// The point that is taken to `q`; exact to 1e-9 m. By Newton's method, with the fixed-point
  /// iteration where that strays.
  Point2 inverse(Point2 q) const;

  /// An upper bound of |derivative of the sum|.
  double slope_bound() const;

 private:
  std::vector<Wave> waves_;
};

/// Waves as the proportions of a drawing go wrong: four along x and four along y that make rooms
/// too long or too short and leave walls straight, and four that bend walls. Wavelengths are
/// uniform on [1, 2] times `shortest_m`; `bend` is the share of the slope that bends, in [0, 1];
/// slope_bound() is `slope`.
SmoothWarp draw_warp(std::mt19937_64& rng, double slope, double shortest_m, double bend);

}  // namespace cmn
