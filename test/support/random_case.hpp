// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Seeded maps, observations and motions for property tests.
#pragma once

#include "coarse_map_nav/data/belief.hpp"
#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/random.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace cmn {

/// Cells occupied with probability `share`; at least one is free.
inline CoarseMap random_map(std::mt19937_64& rng, int width, int height, double share = 0.3) {
  Grid<std::uint8_t> occupied{width, height};
  for (std::uint8_t& cell : occupied.values()) {
    cell = draw_uniform(rng) < share ? 1 : 0;
  }
  occupied[draw_index(rng, occupied.size())] = 0;
  return CoarseMap{std::move(occupied), 0.4};
}

/// size x size cells over `side_m`, values uniform on [0, 1], all seen.
inline LocalOccupancy random_observation(std::mt19937_64& rng, int size, double side_m = 1.28) {
  LocalOccupancy seen{size, side_m / size};
  for (std::size_t i = 0; i < seen.cell_count(); ++i) {
    seen.occupancy[i] = static_cast<float>(draw_uniform(rng));
    seen.confidence[i] = 1.0F;
  }
  return seen;
}

inline double total(const Belief& belief) {
  double sum = 0.0;
  for (const Heading h : kHeadings) {
    for (int y = 0; y < belief.height(); ++y) {
      for (int x = 0; x < belief.width(); ++x) {
        sum += belief(h, {x, y});
      }
    }
  }
  return sum;
}

/// The map turned by a quarter turn to the left.
inline CoarseMap turned_left(const CoarseMap& map) {
  Grid<std::uint8_t> occupied{map.height(), map.width()};
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      occupied({map.height() - 1 - y, x}) = map.occupied()({x, y});
    }
  }
  return CoarseMap{std::move(occupied), map.resolution()};
}

}  // namespace cmn
