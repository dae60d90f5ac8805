// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Colour views -> occupancy around the robot (CMN section IV-B); a network implements it.
#pragma once

#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/perception/color_panorama.hpp"

#include <optional>

namespace cmn {

// The squares that are predicted; cells as LocalOccupancy has them, x forward, y left.
constexpr int kNearSize = 128;        ///< [cells] CMN: 128 x 128 ...
constexpr double kNearSide_m = 1.28;  ///< ... over 1.28 m
constexpr int kWideSize = 64;         ///< [cells]
constexpr double kWideSide_m = 3.2;   ///< the neighbourhood of CMP, table A1

/// What a network makes of one panorama.
///
/// `occupancy` is P(occupied), given that the cell is in sight. `confidence` is P(in sight): that
/// no obstacle and no border of the views hides the cell from the robot's middle. Both are of
/// source kRgb and carry the panorama's stamp. A network that states no confidence has 1
/// everywhere.
struct PredictedOccupancy {
  LocalOccupancy near;
  std::optional<LocalOccupancy> wide;  ///< of networks that look that far
};

class OccupancyPredictor {
 public:
  virtual ~OccupancyPredictor() = default;
  virtual PredictedOccupancy predict(const ColorPanorama& panorama) = 0;
};

}  // namespace cmn
