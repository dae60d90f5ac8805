// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/regions.hpp"

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(LargestRegion, ClosesThePocketsAndNothingElse) {
  const LargestRegion region = largest_region(ascii_map({"..#.", "..##", "#..#", ".#.."}));
  EXPECT_EQ(region.closed_cells, 2U);
  EXPECT_EQ(region.map.occupied(), ascii_map({"..##", "..##", "#..#", "##.."}).occupied());
}

TEST(LargestRegion, KeepsAMapInOnePieceAndItsFrame) {
  const CoarseMap map = ascii_map({"...", ".#."}, 0.3, Pose2{1.0, 2.0, 0.5});
  const LargestRegion region = largest_region(map);
  EXPECT_EQ(region.closed_cells, 0U);
  EXPECT_EQ(region.map.occupied(), map.occupied());
  EXPECT_EQ(region.map.resolution(), 0.3);
  EXPECT_EQ(region.map.T_map_grid().x, 1.0);
}

TEST(LargestRegion, OfAMapWithoutFreeCellsIsThatMap) {
  EXPECT_EQ(largest_region(ascii_map({"##", "##"})).map.free_count(), 0U);
}

}  // namespace
}  // namespace cmn
