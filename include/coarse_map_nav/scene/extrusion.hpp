// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// CoarseMap -> MeshScene: the occupied cells become walls.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/evaluation/house.hpp"
#include "coarse_map_nav/scene/scene.hpp"

#include <vector>

namespace cmn {

struct ExtrusionParams {
  double height_m = 2.5;  ///< of the walls
  bool has_ceiling = true;
};

/// Walls where a free cell borders on an occupied one or on the outside, floor (and ceiling) over
/// the free cells, a lamp every few metres. Faces that continue each other are one.
MeshScene extrude(const CoarseMap& map, const ExtrusionParams& params = {});

/// The cells that hold `value`, as rectangles [cells] that do not overlap; few, not fewest.
std::vector<Rectangle> rectangles_of(const Grid<std::uint8_t>& grid, std::uint8_t value);

/// Lamps under the ceiling of an area without any: one in the middle of every `spacing_m` square.
void add_lamps(MeshScene& scene, const Eigen::AlignedBox3f& area, double spacing_m = 4.0);

}  // namespace cmn
