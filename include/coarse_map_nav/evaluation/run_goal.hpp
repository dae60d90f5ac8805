// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where a journey is to end, as a person says it.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/mapping/place_warp.hpp"
#include "coarse_map_nav/mapping/places.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cmn {

struct RunGoal {
  std::string name;
  Point2 map;                   ///< [m] on the drawing
  std::optional<Point2> world;  ///< [m] where that really is, as far as known
};

/// The places of a drawing, or none when its file is not a YAML file. When they lie in another
/// world than `world_path` (empty: none), the second is false: they say nothing about this one.
/// Throws as read_places().
std::pair<MapPlaces, bool> read_places_in(const std::string& map_path,
                                          const std::string& world_path);

/// From the world to the drawing; empty when there are too few places for one, or they lie on one
/// line.
std::optional<PlaceWarp> warp_to_map(const std::vector<Place>& places);

/// The goal named by `text`: one of the places, or "x y" [m] on the drawing (a comma may stand
/// between); empty: the drawing's default goal. The goal's place in the world is that of the named
/// place, that of a point comes from all the places; `are_here` false: unknown. Throws
/// std::runtime_error that lists the places for a text that is no goal.
RunGoal goal_of(const std::string& text, const MapPlaces& places, bool are_here);

}  // namespace cmn
