// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The same ground on a grid whose axes lie askew.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"

namespace cmn {

/// The whole of `map` on a grid of the same resolution whose axes are turned by `turn_rad` to the
/// left of its own: T_map_grid says so, so every place keeps its coordinates in the map frame. A
/// cell takes the value of the cell that its middle lies in; beyond `map` all is occupied.
CoarseMap turned_map(const CoarseMap& map, double turn_rad);

}  // namespace cmn
