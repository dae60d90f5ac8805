// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/turned_map.hpp"

#include <string>

#include "ascii_map.hpp"
#include "random_case.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(TurnedMap, ByAQuarterTurnHasTheSameCells) {
  std::mt19937_64 rng{1};
  const CoarseMap map = random_map(rng, 7, 5);
  const CoarseMap turned = turned_map(map, kPi / 2.0);
  ASSERT_EQ(turned.width(), 5);
  ASSERT_EQ(turned.height(), 7);
  for (std::size_t i = 0; i < map.occupied().size(); ++i) {
    const Cell c = map.occupied().cell_at(i);
    EXPECT_EQ(turned.is_free(turned.cell_of(map.center_of(c))), map.is_free(c));
  }
}

TEST(TurnedMap, EveryPlaceKeepsItsCoordinates) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const CoarseMap any = random_map(rng, 9, 6);
    const Pose2 T_map_grid{draw_normal(rng), draw_normal(rng), draw_normal(rng)};
    const CoarseMap map{any.occupied(), any.resolution(), T_map_grid};
    const double turn_rad = draw_normal(rng);
    const CoarseMap turned = turned_map(map, turn_rad);
    EXPECT_NEAR(wrap_angle(turned.T_map_grid().yaw - T_map_grid.yaw - turn_rad), 0.0, 1e-12);
    for (std::size_t i = 0; i < turned.occupied().size(); ++i) {
      const Cell c = turned.occupied().cell_at(i);
      EXPECT_EQ(turned.is_free(c), map.is_free(map.cell_of(turned.center_of(c))));
    }
    for (std::size_t i = 0; i < map.occupied().size(); ++i) {
      EXPECT_TRUE(turned.contains(turned.cell_of(map.center_of(map.occupied().cell_at(i)))));
    }
  }
}

TEST(TurnedMap, ByNothingIsTheMap) {
  const CoarseMap map = ascii_map({"##.", "#..", "..."}, 0.5, {1.0, -2.0, 0.3});
  EXPECT_TRUE(is_same_drawing(turned_map(map, 0.0), map));
}

}  // namespace
}  // namespace cmn
