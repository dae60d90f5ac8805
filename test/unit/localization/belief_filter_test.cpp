// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/belief_filter.hpp"

#include <cmath>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

LocalizationParams scaled() {
  LocalizationParams params;
  params.motion.type = "scaled";
  return params;
}

/// What a robot of heading h sees on `map` at `c`: the true 3 x 3 crop (CMN's task CG).
LocalOccupancy crop(const CoarseMap& map, Cell c, Heading h) {
  LocalOccupancy seen{3, 1.28 / 3};
  for (int iy = 0; iy < 3; ++iy) {
    for (int ix = 0; ix < 3; ++ix) {
      const Cell offset = turned(Cell{ix - 1, iy - 1}, index(h));
      seen.occupancy[seen.index_of(ix, iy)] = map.is_occupied(c + offset) ? 1.0F : 0.0F;
      seen.confidence[seen.index_of(ix, iy)] = 1.0F;
    }
  }
  return seen;
}

TEST(BeliefFilter, StartsUniformOverFreeCellsOfAllHeadings) {
  const BeliefFilter filter{ascii_map({"..#", "#.."}), LocalizationParams{}};
  for (const Heading h : kHeadings) {
    EXPECT_DOUBLE_EQ(filter.belief()(h, {0, 1}), 1.0 / 16.0);
    EXPECT_EQ(filter.belief()(h, {2, 1}), 0.0);
  }
  EXPECT_NEAR(entropy(filter.belief()), std::log(16.0), 1e-12);
}

TEST(BeliefFilter, AWholeCellForwardMovesAllMassByOneCell) {
  const CoarseMap map = ascii_map({"....."}, 0.5);
  BeliefFilter filter{map, scaled()};
  ASSERT_TRUE(filter.reset_near({1.25, 0.25, 0.0}, 0.0, 0.0));
  const double before = filter.belief()(Heading::kEast, {2, 0});
  filter.predict({0.5, 0.0, 0});
  EXPECT_NEAR(filter.belief()(Heading::kEast, {3, 0}), before, 1e-12);
}

TEST(BeliefFilter, MassThatFacesAWallStays) {
  const CoarseMap map = ascii_map({"..#"}, 0.5);
  BeliefFilter filter{map, scaled()};
  filter.predict({0.5, 0.0, 0});
  EXPECT_NEAR(filter.belief()(Heading::kEast, {1, 0}), 2.0 / 8.0, 1e-12);
  EXPECT_EQ(filter.belief()(Heading::kEast, {0, 0}), 0.0);
}

TEST(BeliefFilter, AStepToTheLeftMovesEachLayerByItsOwnLeft) {
  const CoarseMap map = ascii_map({"...", "...", "..."}, 0.5);
  BeliefFilter filter{map, scaled()};
  filter.predict({0.0, 0.5, 0});
  EXPECT_EQ(filter.belief()(Heading::kEast, {1, 0}), 0.0);   // left of east is north
  EXPECT_EQ(filter.belief()(Heading::kNorth, {2, 1}), 0.0);  // left of north is west
  EXPECT_EQ(filter.belief()(Heading::kWest, {1, 2}), 0.0);
  EXPECT_EQ(filter.belief()(Heading::kSouth, {0, 1}), 0.0);
}

TEST(BeliefFilter, ALongMotionIsWholeCellsAndARemainderSpreadBilinearly) {
  const CoarseMap map = ascii_map({"........"}, 0.5);
  BeliefFilter filter{map, scaled()};
  ASSERT_TRUE(filter.reset_near({0.25, 0.25, 0.0}, 0.0, 0.0));
  const double at_0 = filter.belief()(Heading::kEast, {0, 0});
  filter.predict({1.25, 0.0, 0});  // two and a half cells
  EXPECT_NEAR(filter.belief()(Heading::kEast, {2, 0}), 0.5 * at_0, 1e-12);
}

TEST(BeliefFilter, FindsItselfByWalkingAlongACorridorWithOneDoor) {
  const CoarseMap map = ascii_map({"##########", "#####.####", "#........#", "##########"}, 0.4);
  LocalizationParams params = scaled();
  params.measurement.exponent = 8.0;  // sharper than the papers': five looks are to be enough
  BeliefFilter filter{map, params};
  Pose2 T_odom_robot;
  for (int x = 1; x <= 5; ++x) {
    filter.update(crop(map, {x, 1}, Heading::kEast), T_odom_robot);
    T_odom_robot.x += 0.4;
  }
  EXPECT_EQ(filter.estimate().heading, Heading::kEast);
  EXPECT_EQ(filter.estimate().cell, (Cell{5, 1}));
  EXPECT_TRUE(filter.is_converged());
}

TEST(BeliefFilter, AContradictionLeavesTheBeliefAndThenReopensIt) {
  // A single free cell cannot look all free with no neighbour occupied: likelihood (1/9)^2 of it.
  const CoarseMap map = ascii_map({"#####", "#...#", "#####"});
  LocalizationParams params = scaled();
  params.contradiction_evidence = 0.2;
  params.reopen_after = 2;
  BeliefFilter filter{map, params};
  ASSERT_TRUE(filter.reset_near({1.5, 1.5, 0.0}, 0.1, 0.1));
  const Belief before = filter.belief();
  LocalOccupancy nothing_near{3, 1.28 / 3};
  nothing_near.occupancy.assign(9, 0.0F);
  nothing_near.confidence.assign(9, 1.0F);
  EXPECT_EQ(filter.correct(nothing_near), Correction::kContradiction);
  for (const Heading h : kHeadings) {
    for (int x = 0; x < 5; ++x) {
      EXPECT_EQ(filter.belief()(h, {x, 1}), before(h, {x, 1}));
    }
  }
  EXPECT_LT(filter.belief()(Heading::kWest, {3, 1}), 1e-3);
  EXPECT_EQ(filter.correct(nothing_near), Correction::kReopened);
  EXPECT_NEAR(filter.belief()(Heading::kWest, {3, 1}), 0.5 / 12.0, 1e-3);
}

TEST(BeliefFilter, TheEstimateIsKeptWhileItIsAmongTheBest) {
  const CoarseMap map = ascii_map({"....", "....", "...."});
  BeliefFilter filter{map, scaled()};
  const Estimate first = filter.estimate();
  for (int i = 0; i < 10; ++i) {
    filter.predict({0.0, 0.0, 0});
    EXPECT_TRUE(filter.estimate() == first);
  }
}

TEST(BeliefFilter, EqualEstimatesAreDrawnWithTheSeed) {
  const CoarseMap map = ascii_map({"....", "....", "...."});
  int differing = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    LocalizationParams params = scaled();
    params.seed = seed;
    const BeliefFilter a{map, params};
    const BeliefFilter b{map, params};
    EXPECT_TRUE(a.estimate() == b.estimate());
    params.seed = seed + 1000;
    differing += BeliefFilter{map, params}.estimate() == a.estimate() ? 0 : 1;
  }
  EXPECT_GT(differing, 15);  // 48 equals: the chance of the same draw is 1 in 48
}

TEST(BeliefFilter, AResetNearAWallFarFromFreeSpaceIsRefused) {
  BeliefFilter filter{ascii_map({"..########"}), scaled()};
  const Belief before = filter.belief();
  EXPECT_FALSE(filter.reset_near({9.5, 0.5, 0.0}, 0.3, 0.1));
  EXPECT_EQ(filter.belief()(Heading::kEast, {0, 0}), before(Heading::kEast, {0, 0}));
}

TEST(BeliefFilter, AResetFavoursTheHeadingOfThePoseInATurnedMapFrame) {
  const CoarseMap map = ascii_map({"...", "...", "..."}, 0.5, Pose2{4.0, 1.0, kPi / 2.0});
  BeliefFilter filter{map, scaled()};
  const Point2 middle = map.center_of({1, 1});
  ASSERT_TRUE(filter.reset_near({middle.x, middle.y, kPi / 2.0}, 0.1, 0.2));
  EXPECT_EQ(filter.estimate().heading, Heading::kEast);  // of the grid's own axes
  EXPECT_EQ(filter.estimate().cell, (Cell{1, 1}));
}

}  // namespace
}  // namespace cmn
