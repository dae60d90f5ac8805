// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A building of any size for the benchmarks that drive through one.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/mapping/regions.hpp"

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>

namespace cmn {

/// Corridors of 6 cells from side to side, between them two rows of rooms of 8 to 18 cells by 12,
/// each with a door of 3 cells to its corridor and some furniture; a cross corridor every 60 cells.
/// Cells of 0.4 m. The same for the same size.
inline CoarseMap office(int side) {
  constexpr int kCorridor = 6;
  constexpr int kDepth = 12;
  constexpr int kBand = kCorridor + 2 * kDepth + 3;  // and three walls
  std::mt19937_64 rng{1};
  const auto from_to = [&](int least, int most) {
    return least + static_cast<int>(draw_index(rng, static_cast<std::size_t>(most - least + 1)));
  };
  Grid<std::uint8_t> occupied{side, side, 1};
  const auto clear = [&](int x, int y, int width, int height, std::uint8_t value) {
    for (int i = std::max(1, y); i < std::min(y + height, side - 1); ++i) {
      for (int j = std::max(1, x); j < std::min(x + width, side - 1); ++j) {
        occupied({j, i}) = value;
      }
    }
  };
  for (int y = 1; y < side; y += kBand) {
    clear(1, y, side, kCorridor, 0);
    for (int row = 0; row < 2; ++row) {
      const int floor_y = y + kCorridor + 1 + row * (kDepth + 1);
      const int door_y = row == 0 ? floor_y - 1 : floor_y + kDepth;
      for (int x = 1; x < side;) {
        const int width = from_to(8, 18);
        clear(x, floor_y, width, kDepth, 0);
        clear(x + from_to(1, width - 4), door_y, 3, 1, 0);
        for (int i = from_to(1, 4); i > 0; --i) {
          const int table_x = x + from_to(0, width - 3);
          clear(table_x, floor_y + from_to(2, kDepth - 4), from_to(1, 3), from_to(1, 2), 1);
        }
        x += width + 1;
      }
    }
  }
  for (int x = 30; x < side; x += 60) {
    clear(x, 1, kCorridor, side, 0);
  }
  return largest_region(CoarseMap{std::move(occupied), 0.4}).map;
}

}  // namespace cmn
