// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// MeshScene -> CoarseMap: where a robot on the floor can go.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/evaluation/house.hpp"
#include "coarse_map_nav/scene/scene.hpp"

#include <optional>

namespace cmn {

struct SliceParams {
  double resolution_m = 0.05;
  double floor_m = 0.0;  ///< height of the floor
  /// What stands in the way has a surface within these heights above the floor.
  HeightBand band{0.02, 0.6};
  /// A point of the area that is meant. None: the largest area that is closed all round, or the
  /// largest at all.
  std::optional<Point2> inside;
};

/// A cell is free when nothing in it lies within the band, there is floor, and it belongs to one
/// piece with the area that is meant: hollow furniture and the outdoors are none of it. Surfaces
/// take up every cell that they cross by more than a millimetre; clear panes do as well.
///
/// The grid's axes are the scene's, its cells' borders multiples of the resolution. Throws
/// std::runtime_error when no cell is free or the grid would have more than 64 million cells.
CoarseMap slice(const MeshScene& scene, const SliceParams& params);

}  // namespace cmn
