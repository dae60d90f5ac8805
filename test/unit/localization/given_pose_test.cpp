// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/given_pose.hpp"

#include <cmath>
#include <string>

#include "ascii_map.hpp"
#include "random_case.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(GivenPose, IsCertainOfThePoseItWasTold) {
  const CoarseMap map = ascii_map({"...", "..."}, 0.5, {1.0, 2.0, kPi / 2});
  GivenPose told{map};
  told.place({0.6, 2.3, kPi});
  EXPECT_EQ(told.update({}, {}), Correction::kApplied);
  const Localization at = told.localization();
  // In the grid: 0.3 m along x (north of the map frame), 0.4 m along y (west), facing north.
  EXPECT_EQ(at.estimate, (Estimate{Heading::kNorth, {0, 0}, 1.0}));
  EXPECT_NEAR(at.position_cells.x, 0.6, 1e-9);
  EXPECT_NEAR(at.position_cells.y, 0.8, 1e-9);
  EXPECT_NEAR(at.yaw_rad, kPi / 2, 1e-9);
  EXPECT_EQ(at.confidence, 1.0);
  EXPECT_TRUE(at.is_converged);
  EXPECT_EQ(at.belief(Heading::kNorth, {0, 0}), 1.0);
  EXPECT_EQ(total(at.belief), 1.0);
}

TEST(GivenPose, ForgetsWhereItWasTold) {
  const CoarseMap map = ascii_map({"..."});
  GivenPose told{map};
  told.place({0.5, 0.5, 0.0});
  told.place({2.5, 0.5, -kPi / 2});
  EXPECT_EQ(told.localization().belief(Heading::kSouth, {2, 0}), 1.0);
  EXPECT_EQ(total(told.localization().belief), 1.0);
}

TEST(GivenPose, BelievesInTheNearestFreeCell) {
  std::mt19937_64 rng{1};
  for (int i = 0; i < 50; ++i) {
    SCOPED_TRACE("map " + std::to_string(i));
    const CoarseMap map = random_map(rng, 9, 6, 0.9);
    GivenPose told{map};
    const Cell truth{static_cast<int>(draw_index(rng, 13)) - 2,
                     static_cast<int>(draw_index(rng, 10)) - 2};
    told.place({map.resolution() * (truth.x + 0.5), map.resolution() * (truth.y + 0.5), 0.0});
    int least = 1000;
    for (std::size_t k = 0; k < map.occupied().size(); ++k) {
      const Cell c = map.occupied().cell_at(k);
      const Cell off = c - truth;
      least = map.is_free(c) ? std::min(least, off.x * off.x + off.y * off.y) : least;
    }
    const Cell off = told.localization().estimate.cell - truth;
    EXPECT_TRUE(map.is_free(told.localization().estimate.cell));
    EXPECT_EQ(off.x * off.x + off.y * off.y, least);
  }
}

}  // namespace
}  // namespace cmn
