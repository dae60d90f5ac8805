// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Who moves in: furniture for each room, by its purpose.
#pragma once

#include "coarse_map_nav/evaluation/house.hpp"
#include "coarse_map_nav/evaluation/house_generator.hpp"

#include <random>

namespace cmn {

/// Furnishes all rooms: what a room is for comes first (a bed, a sofa before the television, a
/// kitchen counter along the wall), then what fits. No piece stands in a door or in another piece;
/// a chair may be pushed under its table.
void furnish(House& house, std::mt19937_64& rng, const HouseParams& params);

}  // namespace cmn
