// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Rooms, doors and windows of a home that nobody has moved into yet.
#pragma once

#include "coarse_map_nav/evaluation/house.hpp"
#include "coarse_map_nav/evaluation/house_generator.hpp"

#include <random>

namespace cmn {

/// Draws a floor plan: rooms on one or both sides of a hall, and in most a living room across its
/// end. All rooms are joined by doors or passages. All coordinates are multiples of 5 cm. The
/// result has no furniture.
House draw_floor_plan(std::mt19937_64& rng, const HouseParams& params);

}  // namespace cmn
