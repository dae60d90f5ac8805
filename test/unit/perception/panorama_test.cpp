// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/panorama.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr int kSize = 12;
constexpr double kCell_m = 0.1;

/// Sees the quarter ahead of the robot: free, and occupied beyond `range_m`.
LocalOccupancy quarter_ahead(double range_m) {
  LocalOccupancy look{kSize, kCell_m};
  for (int iy = 0; iy < kSize; ++iy) {
    for (int ix = 0; ix < kSize; ++ix) {
      const Point2 p{(ix + 0.5 - 0.5 * kSize) * kCell_m, (iy + 0.5 - 0.5 * kSize) * kCell_m};
      if (p.x > std::abs(p.y)) {
        look.occupancy[look.index_of(ix, iy)] = norm(p) < range_m ? 0.0F : 1.0F;
        look.confidence[look.index_of(ix, iy)] = 1.0F;
      }
    }
  }
  return look;
}

std::size_t at(const LocalOccupancy& local, double x, double y) {
  return local.index_of(static_cast<int>(std::floor(x / local.resolution)) + local.size / 2,
                        static_cast<int>(std::floor(y / local.resolution)) + local.size / 2);
}

Pose2 facing(int quarter, double error_rad = 0.0) {
  return {1.0, 2.0, quarter * kPi / 2.0 + error_rad};
}

TEST(Panorama, IsCompleteOnceTheRobotHasLookedAllRoundAndFacesWhereItBegan) {
  Panorama panorama{PanoramaParams{}};
  for (int turn = 0; turn < 4; ++turn) {
    panorama.fuse(quarter_ahead(9.0), facing(turn, 0.02 * turn));
    EXPECT_FALSE(panorama.is_complete()) << turn;
  }
  const LocalOccupancy all = panorama.fuse(quarter_ahead(9.0), facing(4));
  EXPECT_TRUE(panorama.is_complete());
  for (const Point2 p : {Point2{0.5, 0.0}, {0.0, 0.5}, {-0.5, 0.0}, {0.0, -0.5}}) {
    EXPECT_EQ(all.confidence[at(all, p.x, p.y)], 1.0F);
  }
  panorama.fuse(quarter_ahead(9.0), facing(1));
  EXPECT_TRUE(panorama.is_complete()) << "a turn on the spot costs no new panorama";
  panorama.fuse(quarter_ahead(9.0), {1.15, 2.0, 0.0});
  EXPECT_FALSE(panorama.is_complete()) << "a step does";
  panorama.forget();
  EXPECT_FALSE(panorama.is_complete());
}

TEST(Panorama, ManyLooksAtOneHeadingAreOne) {
  Panorama panorama{PanoramaParams{}};
  for (int turn = 0; turn < 5; ++turn) {
    for (int look = 0; look < 20; ++look) {
      panorama.fuse(quarter_ahead(9.0), facing(turn, 0.001 * look));
      EXPECT_EQ(panorama.is_complete(), turn == 4) << turn;
    }
  }
}

TEST(Panorama, ARobotThatStartsBetweenItsAxesIsNotTrappedInTurning) {
  Panorama panorama{PanoramaParams{}};
  panorama.fuse(quarter_ahead(9.0), facing(0, 0.6));  // a turn to the left ends on an axis
  for (int turn = 1; turn < 6 && !panorama.is_complete(); ++turn) {
    panorama.fuse(quarter_ahead(9.0), facing(turn));
  }
  EXPECT_TRUE(panorama.is_complete());
}

TEST(Panorama, LooksLieWhereOdometrySaysTheyWereMade) {
  Panorama panorama{PanoramaParams{}};
  panorama.fuse(quarter_ahead(0.3), facing(0));
  // A quarter turn to the left: what was ahead is to the right.
  const LocalOccupancy all = panorama.fuse(quarter_ahead(9.0), facing(1));
  EXPECT_EQ(all.occupancy[at(all, 0.05, -0.55)], 1.0F);
  EXPECT_EQ(all.occupancy[at(all, 0.05, -0.25)], 0.0F);
  EXPECT_EQ(all.occupancy[at(all, 0.55, 0.05)], 0.0F);
  EXPECT_EQ(all.confidence[at(all, -0.5, 0.0)], 0.0F) << "nobody looked there";
}

TEST(Panorama, AMostlyOccupiedCornerIsFilledAndNoOther) {
  PanoramaParams params;
  params.corner_share = 0.5;
  params.corner_side_m = 1.2;  // corners of 4 x 4 cells
  LocalOccupancy seen{kSize, kCell_m};
  for (int i = 0; i < 9; ++i) {
    seen.occupancy[seen.index_of(i % 4, i / 4)] = 1.0F;  // 9 of 16 at the lower left
    seen.occupancy[seen.index_of(11 - i % 4, 11 - i / 4)] = i < 8 ? 1.0F : 0.0F;  // 8 at the other
  }
  fill_corners(seen, params);
  for (int i = 0; i < 16; ++i) {
    EXPECT_EQ(seen.occupancy[seen.index_of(i % 4, i / 4)], 1.0F);
    EXPECT_EQ(seen.confidence[seen.index_of(i % 4, i / 4)], 1.0F);
  }
  EXPECT_EQ(seen.occupancy[seen.index_of(11, 8)], 0.5F);
  EXPECT_EQ(seen.confidence[seen.index_of(6, 6)], 0.0F);
}

}  // namespace
}  // namespace cmn
