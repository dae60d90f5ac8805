// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/data/look_contradiction.hpp"

#include <string>

#include "wanderer.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(LookContradiction, IsNothingBetweenLooksOfAWalk) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Wanderer robot{seed};
    LocalOccupancy before = robot.look();
    for (int i = 0; i < 40; ++i) {
      const Pose2 T_odom_before = robot.T_odom_robot;
      robot.step();
      // And an odometry that errs by a slip of 0.1 m and 2 degrees.
      const Pose2 T_before_now = inverse(T_odom_before) * robot.T_odom_robot;
      const LocalOccupancy now = robot.look();
      ASSERT_LT(contradiction(before, now, T_before_now * Pose2{0.1, 0.0, 0.035}), 0.06) << i;
      before = now;
    }
  }
}

TEST(LookContradiction, IsGreatBetweenLooksOfTwoPlaces) {
  int great = 0;
  int tried = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Wanderer robot{seed};
    const Point2 from = robot.T_world_robot.position();
    const LocalOccupancy before = robot.look();
    robot.be_put_elsewhere();
    if (norm(robot.T_world_robot.position() - from) > 2.0) {
      ++tried;
      great += contradiction(before, robot.look(), {}) > 0.2;
    }
  }
  EXPECT_GE(great, tried / 3) << "of " << tried;  // rooms of 3 m: 30 of 77
}

TEST(LookContradiction, NeedsSomethingToCompare) {
  Wanderer robot{3};
  const LocalOccupancy look = robot.look();
  EXPECT_EQ(contradiction(look, look, {}), 0.0);
  EXPECT_EQ(contradiction(look, look, {50.0, 0.0, 0.0}), 0.0);  // out of each other's view
  EXPECT_EQ(contradiction(LocalOccupancy{80, 0.1}, look, {}), 0.0);
  EXPECT_EQ(contradiction(LocalOccupancy{}, look, {}), 0.0);
}

}  // namespace
}  // namespace cmn
