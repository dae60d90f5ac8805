// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A drawing that somebody made, with what is known of where its places lie in the world.
#pragma once

#include "coarse_map_nav/evaluation/drawing.hpp"
#include "coarse_map_nav/mapping/places.hpp"

#include <vector>

namespace cmn {

/// The truth about it is a PlaceWarp through the places. Throws std::runtime_error when they do not
/// tell it (see PlaceWarp), when they fold or mirror the world somewhere on its free ground, or
/// when less than half of that ground lies on the map.
Drawing given_drawing(CoarseMap map, const std::vector<Place>& places, const CoarseMap& world);

}  // namespace cmn
