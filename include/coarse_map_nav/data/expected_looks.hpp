// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the drawing makes one expect to see: how planning asks localization where it will know
/// more.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <vector>

namespace cmn {

/// A pose on the drawing: x, y in cells of the grid, cell (0, 0) from 0 to 1.
struct GridPose {
  Point2 position_cells;
  double yaw_rad = 0.0;  ///< in the axes of the grid
};

/// Of a drawing, by whoever localizes on it.
class ExpectedLooks {
 public:
  virtual ~ExpectedLooks() = default;
  /// How fast looks tell these poses from each other: the log likelihood ratio that is expected
  /// where one of a pair is true [nats per metre driven], of the pairs (0, 1), (0, 2), ...,
  /// (1, 2), ... At poses that no robot can stand at nothing is expected, and nothing told.
  /// `scale`: drawn metres a metre.
  virtual std::vector<double> apart(const std::vector<GridPose>& poses, double scale) const = 0;
};

}  // namespace cmn
