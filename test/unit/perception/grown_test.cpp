// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/grown.hpp"

#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

namespace cmn {
namespace {

/// Free and seen all over, in cells of 0.1 m.
LocalOccupancy open_ground(int size) {
  LocalOccupancy seen{size, 0.1};
  seen.occupancy.assign(seen.cell_count(), 0.0F);
  seen.confidence.assign(seen.cell_count(), 1.0F);
  seen.source = ObservationSource::kRgb;
  seen.stamp_s = 3.0;
  return seen;
}

int occupied_count(const LocalOccupancy& seen) {
  int count = 0;
  for (const float occupancy : seen.occupancy) {
    count += occupancy > 0.5F;
  }
  return count;
}

TEST(Grown, ByNothingIsTheSame) {
  LocalOccupancy seen = open_ground(20);
  seen.occupancy[seen.index_of(15, 10)] = 1.0F;
  const LocalOccupancy same = grown(seen, 0.0, 20);
  EXPECT_EQ(same.occupancy, seen.occupancy);
  EXPECT_EQ(same.confidence, seen.confidence);
  const ProjectionParams grid{160, 16.0, 0.2};
  EXPECT_EQ(with_margin(grid, 0.0).size, 160);
  EXPECT_EQ(with_margin(grid, 0.0).side_m, 16.0);
}

TEST(Grown, APostBecomesADisc) {
  LocalOccupancy seen = open_ground(40);
  seen.occupancy[seen.index_of(30, 10)] = 1.0F;
  const LocalOccupancy larger = grown(seen, 0.3, 40);
  EXPECT_EQ(larger.source, ObservationSource::kRgb);
  EXPECT_EQ(larger.stamp_s, 3.0);
  int wrong = 0;
  for (int iy = 0; iy < 40; ++iy) {
    for (int ix = 0; ix < 40; ++ix) {
      const bool is_near = 0.1 * std::hypot(ix - 30, iy - 10) <= 0.35;
      wrong += (larger.occupancy[larger.index_of(ix, iy)] > 0.5F) != is_near;
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST(Grown, WhatWasNotSeenGrowsNot) {
  LocalOccupancy seen = open_ground(20);
  const std::size_t behind = seen.index_of(15, 10);
  seen.occupancy[behind] = 1.0F;
  seen.confidence[behind] = 0.0F;
  EXPECT_EQ(occupied_count(grown(seen, 0.3, 20)), 1);
}

TEST(Grown, CoversNotWhereTheRobotStands) {
  // A wall 0.15 m to the left of a robot of 0.3 m: it slides along it.
  LocalOccupancy seen = open_ground(20);
  for (int ix = 0; ix < 20; ++ix) {
    seen.occupancy[seen.index_of(ix, 11)] = 1.0F;
  }
  const LocalOccupancy larger = grown(seen, 0.3, 20);
  for (const int ix : {9, 10}) {
    for (const int iy : {9, 10}) {
      EXPECT_EQ(larger.occupancy[larger.index_of(ix, iy)], 0.0F) << ix << " " << iy;
    }
  }
  EXPECT_EQ(larger.occupancy[larger.index_of(18, 8)], 1.0F) << "farther on it grows in full";
}

TEST(Grown, WhatStandsOutsideReachesIn) {
  const ProjectionParams grid{12, 1.2, 0.0};
  const ProjectionParams wider = with_margin(grid, 0.25);
  EXPECT_EQ(wider.size, 18);
  EXPECT_NEAR(wider.side_m, 1.8, 1e-12);
  LocalOccupancy seen = open_ground(wider.size);
  seen.occupancy[seen.index_of(16, 9)] = 1.0F;  // one cell beyond the middle square's border
  const LocalOccupancy larger = grown(seen, 0.25, grid.size);
  EXPECT_EQ(larger.size, grid.size);
  EXPECT_EQ(larger.occupancy[larger.index_of(11, 6)], 1.0F);
  EXPECT_EQ(larger.occupancy[larger.index_of(9, 6)], 0.0F);
}

}  // namespace
}  // namespace cmn
