// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The maps that the benchmarks run on.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/random.hpp"

#include <cstdint>
#include <utility>

namespace cmn {

/// Rooms of 8 x 8 cells with a door in every wall and a little furniture.
inline CoarseMap rooms(int width, int height) {
  std::mt19937_64 rng{1};
  Grid<std::uint8_t> occupied{width, height};
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    const Cell c = occupied.cell_at(i);
    const bool is_wall = c.x % 9 == 0 || c.y % 9 == 0;
    const bool is_door = (c.x % 9 == 0) != (c.y % 9 == 0) && (c.x % 9 == 4 || c.y % 9 == 4);
    const bool is_middle = c.x % 9 == 4 || c.y % 9 == 4;
    occupied[i] = (is_wall && !is_door) || (!is_wall && !is_middle && draw_uniform(rng) < 0.1);
  }
  return CoarseMap{std::move(occupied), 0.4};
}

/// The middle of a room at one end of the map and of one at the other.
inline Cell first_middle() { return {4, 4}; }
inline Cell last_middle(const CoarseMap& map) {
  return {(map.width() - 5) / 9 * 9 + 4, (map.height() - 5) / 9 * 9 + 4};
}

}  // namespace cmn
