// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a network predicts -> the grid that everything after perception works on.
#pragma once

#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/perception/occupancy_predictor.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

namespace cmn {

/// The near square where it reaches, around it the wide one, nothing beyond.
///
/// As of a LiDAR, what is out of sight, P(in sight) less than `least_in_sight`, has confidence 0
/// and occupancy 1; what is in sight keeps both of its numbers. Of several predicted cells in one
/// of the grid, one that is in sight and occupied counts before one that is free.
/// Cost: O(cells of the grid and of what is predicted).
LocalOccupancy laid_on_grid(const PredictedOccupancy& predicted, const ProjectionParams& grid,
                            double least_in_sight);

}  // namespace cmn
