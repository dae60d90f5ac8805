// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/neighbourhood.hpp"

#include "coarse_map_nav/data/belief.hpp"

#include <cstdint>
#include <random>
#include <utility>

#include "random_case.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

/// Each cell cut into cuts x cuts.
CoarseMap blown_up(const CoarseMap& map, int cuts) {
  Grid<std::uint8_t> occupied{map.width() * cuts, map.height() * cuts};
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    const Cell c = occupied.cell_at(i);
    occupied[i] = map.is_occupied({c.x / cuts, c.y / cuts}) ? 1 : 0;
  }
  return {std::move(occupied), map.resolution() / cuts, map.T_map_grid()};
}

TEST(WindowKinds, ACellsKindTellsItsWindowAndItsNeighbours) {
  std::mt19937_64 rng{3};
  const CoarseMap map = random_map(rng, 9, 7);
  const Belief layout{map.width(), map.height()};
  for (const int reach : {0, 1, 2, 4}) {
    const WindowKinds kinds{map, reach};
    const int n = 2 * reach + 1;
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        const std::size_t kind = kinds.of_cell[layout.padded_index({x, y})];
        if (map.is_occupied({x, y})) {
          EXPECT_EQ(kind, 0U);
          continue;
        }
        for (int w = 0; w < n * n; ++w) {
          const bool is_occupied = map.is_occupied({x - reach + w % n, y - reach + w / n});
          const unsigned code = kinds.codes[kind * kinds.pieces + static_cast<std::size_t>(w / 9)];
          ASSERT_EQ((code >> static_cast<unsigned>(w % 9)) % 2 == 1, is_occupied);
        }
        for (const Heading h : kHeadings) {
          const Cell step = unit_step(h);
          ASSERT_EQ((kinds.neighbourhoods[kind] & neighbour_bit(step)) != 0,
                    map.is_occupied(Cell{x, y} + step));
        }
      }
    }
  }
}

TEST(WindowKinds, RunsHoldEachFreeCellOnce) {
  std::mt19937_64 rng{4};
  const CoarseMap map = random_map(rng, 12, 9);
  Grid<std::uint8_t> held{map.width(), map.height()};
  for (const WindowKinds::Run& run : WindowKinds{map, 1}.runs) {
    for (int i = 0; i < run.count; ++i) {
      ++held(run.first + Cell{i, 0});
    }
  }
  for (std::size_t i = 0; i < held.size(); ++i) {
    EXPECT_EQ(held[i], map.is_free(held.cell_at(i)) ? 1 : 0);
  }
}

TEST(WindowKinds, ABlownUpDrawingHasNoMoreOfThemThanItsCellsHaveSurroundings) {
  std::mt19937_64 rng{5};
  const CoarseMap drawing = random_map(rng, 20, 20);
  const CoarseMap map = blown_up(drawing, 3);
  // Windows of nine thirds of a cell, at nine places within a cell, reach over 5 x 5 cells.
  EXPECT_LE(WindowKinds(map, 4).size(), 1 + 9 * (WindowKinds(drawing, 2).size() - 1));
}

}  // namespace
}  // namespace cmn
