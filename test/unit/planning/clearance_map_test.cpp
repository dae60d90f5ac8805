// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/clearance_map.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace cmn {
namespace {

/// All free, of 0.1 m cells.
LocalOccupancy hall(int size) {
  LocalOccupancy seen{size, 0.1};
  std::fill(seen.occupancy.begin(), seen.occupancy.end(), 0.0F);
  std::fill(seen.confidence.begin(), seen.confidence.end(), 1.0F);
  return seen;
}

TEST(ClearanceMap, ReachesFromTheMiddleOfACellToTheBorderOfTheNearestOccupiedOne) {
  LocalOccupancy seen = hall(21);
  seen.occupancy[seen.index_of(10, 10)] = 1.0F;
  ClearanceMap map;
  map.measure(seen);
  EXPECT_EQ(map.at_cell(10, 10), 0.0);
  EXPECT_NEAR(map.at_cell(14, 10), 0.35, 1e-3);
  EXPECT_NEAR(map.at_cell(13, 6), 0.45, 0.01);
  EXPECT_NEAR(map.at({-0.5, 0.0}), 0.45, 1e-3);
}

TEST(ClearanceMap, KnowsWhatIsTooNearToAWallAlsoWhereItWasNotSeen) {
  LocalOccupancy seen = hall(21);
  for (int iy = 0; iy < seen.size; ++iy) {
    seen.occupancy[seen.index_of(15, iy)] = 1.0F;
    for (int ix = 16; ix < seen.size; ++ix) {
      seen.confidence[seen.index_of(ix, iy)] = 0.0F;
    }
  }
  ClearanceMap map;
  map.measure(seen);
  EXPECT_EQ(map.at_cell(16, 10), ClearanceMap::kUnseen);
  EXPECT_TRUE(map.is_nearer_than(0.19, seen.index_of(16, 10)));
  EXPECT_TRUE(map.is_nearer_than(0.19, seen.index_of(14, 10)));
  EXPECT_FALSE(map.is_nearer_than(0.19, seen.index_of(18, 10)));
  EXPECT_FALSE(map.is_nearer_than(0.19, seen.index_of(12, 10)));
}

TEST(ClearanceMap, IsLargeEverywhereWhereNothingIsOccupied) {
  ClearanceMap map;
  map.measure(hall(5));
  EXPECT_GT(map.at({0.2, -0.2}), 100.0);
}

TEST(ClearanceMap, IsUnseenOutside) {
  ClearanceMap map;
  map.measure(LocalOccupancy{5, 0.1});
  EXPECT_EQ(map.at({0.26, 0.0}), ClearanceMap::kUnseen);
  EXPECT_EQ(map.at({0.0, -0.26}), ClearanceMap::kUnseen);
}

}  // namespace
}  // namespace cmn
