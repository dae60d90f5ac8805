// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What hangs together on a drawing.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"

#include <cstddef>

namespace cmn {

/// A map without its closed pockets, and how many cells that cost.
struct LargestRegion {
  CoarseMap map;
  std::size_t closed_cells = 0;
};
/// Free cells that are not joined to the largest free region (over the four sides of a cell) become
/// occupied. A robot in such a pocket could not reach any goal outside it, nor have come there.
LargestRegion largest_region(const CoarseMap& map);

}  // namespace cmn
