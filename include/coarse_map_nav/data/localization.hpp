// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where the robot takes itself to be.
#pragma once

#include "coarse_map_nav/data/belief.hpp"
#include "coarse_map_nav/data/expected_looks.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace cmn {

/// What localization hands to planning. Refers to the localizer's belief: good until its next step.
struct Localization {
  const Belief& belief;
  Estimate estimate;
  /// Finer than the estimate's cell: x, y in cells of the grid, cell (0, 0) from 0 to 1.
  Point2 position_cells;
  double yaw_rad = 0.0;     ///< likewise finer than its heading, in the axes of the grid
  double confidence = 0.0;  ///< probability within 1 m of the estimate, at its heading
  bool is_converged = false;
  double scale = 1.0;  ///< nominal map metres a metre, as far as it is estimated
  /// Yaw of the axes that the robot keeps to, in the frame of the odometry.
  double axes_yaw_rad = 0.0;
  /// All states of the belief that are not 0, in no order, each with its index in the padded layer;
  /// null where they are many or the localizer does not list them.
  const std::vector<std::pair<Heading, std::uint32_t>>* possible = nullptr;
  const ExpectedLooks* looks = nullptr;  ///< what it expects to see, where it can tell
};

}  // namespace cmn
