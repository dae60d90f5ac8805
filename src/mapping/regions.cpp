// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/regions.hpp"

#include <cstdint>
#include <vector>

namespace cmn {
namespace {

std::vector<Cell> region_from(const CoarseMap& map, Cell seed, Grid<std::uint8_t>& seen) {
  std::vector<Cell> region{seed};
  seen(seed) = 1;
  for (std::size_t i = 0; i < region.size(); ++i) {
    for (const Heading h : kHeadings) {
      const Cell next = region[i] + unit_step(h);
      if (map.is_free(next) && seen(next) == 0) {
        seen(next) = 1;
        region.push_back(next);
      }
    }
  }
  return region;
}

}  // namespace

LargestRegion largest_region(const CoarseMap& map) {
  Grid<std::uint8_t> seen{map.width(), map.height()};
  std::vector<Cell> largest;
  for (std::size_t i = 0; i < map.occupied().size(); ++i) {
    const Cell c = map.occupied().cell_at(i);
    if (map.is_free(c) && seen(c) == 0) {
      std::vector<Cell> region = region_from(map, c, seen);
      if (region.size() > largest.size()) {
        largest = std::move(region);
      }
    }
  }
  Grid<std::uint8_t> occupied{map.width(), map.height(), 1};
  for (const Cell c : largest) {
    occupied(c) = 0;
  }
  return {CoarseMap{std::move(occupied), map.resolution(), map.T_map_grid()},
          map.free_count() - largest.size()};
}

}  // namespace cmn
