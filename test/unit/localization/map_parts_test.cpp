// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/map_parts.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kMany = 1e9;

TEST(MapParts, AreNoLargerThanAskedFor) {
  const CoarseMap map = ascii_map({"#..", "..#"}, 0.5);
  EXPECT_EQ(MapParts(map, 0.5, kMany).cuts(), 1);
  EXPECT_EQ(MapParts(map, 0.25, kMany).cuts(), 2);
  EXPECT_EQ(MapParts(map, 0.2, kMany).cuts(), 3);
  EXPECT_EQ(MapParts(map, 10.0, kMany).cuts(), 1);
}

TEST(MapParts, AreLargerWhereTheyWereTooMany) {
  const CoarseMap map = ascii_map({"#..", "..#"}, 0.5);  // four free cells
  EXPECT_EQ(MapParts(map, 0.1, 100.0).cuts(), 5);
  EXPECT_EQ(MapParts(map, 0.1, 99.0).cuts(), 4);
  EXPECT_EQ(MapParts(map, 0.1, 1.0).cuts(), 1) << "never larger than cells";
}

TEST(MapParts, UncutAreTheDrawing) {
  const CoarseMap map = ascii_map({"#..", "..#"}, 0.5);
  EXPECT_TRUE(is_same_drawing(MapParts(map, 0.5, kMany).map(), map));
}

TEST(MapParts, LieWhereTheirCellsLie) {
  const CoarseMap map = ascii_map({"#...", "..#."}, 0.5);
  const MapParts parts{map, 0.2, kMany};
  ASSERT_EQ(parts.map().occupied().size(), 9 * map.occupied().size());
  for (std::size_t i = 0; i < parts.map().occupied().size(); ++i) {
    const Cell part = parts.map().occupied().cell_at(i);
    const Cell cell = parts.cell_of(part);
    EXPECT_EQ(cell, map.cell_of(parts.map().center_of(part)));
    EXPECT_EQ(parts.map().is_free(part), map.is_free(cell));
    const auto at = parts.padded_index(part);
    EXPECT_LT(at, parts.padded_size());
    EXPECT_EQ(parts.part_of(static_cast<std::uint32_t>(at)), part);
    const std::vector<Cell> there = parts.parts_in(cell);
    EXPECT_EQ(there.size(), 9U);
    EXPECT_NE(std::find(there.begin(), there.end(), part), there.end());
  }
}

TEST(MapParts, NearACellAreAllWithinReachOfItsMiddle) {
  const CoarseMap map = ascii_map({"....", "....", "....", "...."}, 0.4);
  for (const double part_m : {0.4, 0.2, 0.14}) {
    for (const double radius_m : {0.1, 0.4, 0.75, 3.0}) {
      SCOPED_TRACE(std::to_string(part_m) + " " + std::to_string(radius_m));
      const MapParts parts{map, part_m, kMany};
      const Cell cell{1, 0};
      std::vector<Cell> expected;
      for (std::size_t i = 0; i < parts.map().occupied().size(); ++i) {
        const Cell part = parts.map().occupied().cell_at(i);
        if (norm(parts.map().center_of(part) - map.center_of(cell)) <= radius_m + 1e-9) {
          expected.push_back(part);
        }
      }
      EXPECT_EQ(parts.parts_near(cell, radius_m + 1e-9), expected);
    }
  }
}

}  // namespace
}  // namespace cmn
