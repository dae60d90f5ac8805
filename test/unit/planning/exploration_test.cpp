// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/exploration.hpp"

#include <string>

#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr auto kForward = ActionType::kMoveForward;
constexpr auto kLeft = ActionType::kTurnLeft;
constexpr auto kRight = ActionType::kTurnRight;

TEST(Exploration, WanderGoesMostlyForwardAndTurnsBothWays) {
  std::mt19937_64 rng{1};
  Exploration exploration;
  int forward = 0;
  int left = 0;
  int right = 0;
  for (int i = 0; i < 10000; ++i) {
    const ActionType action = exploration.wander(false, 0.1, rng);
    forward += action == kForward;
    left += action == kLeft;
    right += action == kRight;
  }
  // One turn in 11 actions: after each turn a forced step. 909 expected, 3 sigma = 80.
  EXPECT_NEAR(left + right, 909, 80);
  EXPECT_NEAR(left, right, 90);
  EXPECT_EQ(forward + left + right, 10000);
}

TEST(Exploration, WanderGoesForwardAfterATurnWhenItCan) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    Exploration exploration;
    ASSERT_NE(exploration.wander(true, 1.0, rng), kForward);
    ASSERT_EQ(exploration.wander(false, 1.0, rng), kForward);
  }
}

TEST(Exploration, WanderTurnsOnToTheSameSideInACorner) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    Exploration exploration;
    const ActionType side = exploration.wander(true, 0.1, rng);
    ASSERT_EQ(exploration.wander(true, 0.1, rng), side);
    ASSERT_EQ(exploration.wander(true, 0.1, rng), side);
    ASSERT_EQ(exploration.wander(false, 0.1, rng), kForward);
  }
}

TEST(Exploration, FollowDoesAsWishedWhenNothingIsInTheWay) {
  Exploration exploration;
  EXPECT_EQ(exploration.follow(kForward, false, kLeft), kForward);
  EXPECT_EQ(exploration.follow(kLeft, false, kLeft), kLeft);
  EXPECT_EQ(exploration.follow(kLeft, false, kLeft), kLeft);
  EXPECT_EQ(exploration.follow(kForward, false, kLeft), kForward);
  EXPECT_EQ(exploration.follow(kRight, false, kLeft), kRight);
  EXPECT_EQ(exploration.follow(kRight, true, kLeft), kRight);
}

TEST(Exploration, FollowDoesNotTakeATurnBackAtOnce) {
  Exploration exploration;
  EXPECT_EQ(exploration.follow(kLeft, false, kLeft), kLeft);
  EXPECT_EQ(exploration.follow(kRight, false, kLeft), kForward);
  EXPECT_EQ(exploration.follow(kRight, false, kLeft), kRight);
  EXPECT_EQ(exploration.follow(kLeft, true, kLeft), kRight);
}

TEST(Exploration, FollowMakesEachDetourTwiceAsLongThenBeginsAgain) {
  Exploration exploration;
  for (const int length : {1, 2, 4, 8, 16, 1, 2}) {
    SCOPED_TRACE("detour of " + std::to_string(length));
    ASSERT_EQ(exploration.follow(kForward, true, kLeft), kLeft);
    for (int i = 0; i < length; ++i) {
      ASSERT_EQ(exploration.follow(kRight, false, kLeft), kForward);
    }
    ASSERT_EQ(exploration.follow(kRight, false, kLeft), kRight);
  }
}

TEST(Exploration, FollowBeginsWithShortDetoursAgainOnceThePlanWorks) {
  Exploration exploration;
  exploration.follow(kForward, true, kLeft);  // turn
  exploration.follow(kRight, false, kLeft);   // the one step
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(exploration.follow(kForward, false, kLeft), kForward);
  }
  ASSERT_EQ(exploration.follow(kForward, true, kRight), kRight);
  ASSERT_EQ(exploration.follow(kLeft, false, kRight), kForward);
  ASSERT_EQ(exploration.follow(kLeft, false, kRight), kLeft);
}

TEST(Exploration, FollowEndsADetourThatIsBlockedItself) {
  Exploration exploration;
  exploration.follow(kForward, true, kLeft);
  exploration.follow(kRight, false, kLeft);
  exploration.follow(kRight, false, kLeft);
  ASSERT_EQ(exploration.follow(kForward, true, kLeft), kLeft);  // a detour of 2 begins
  ASSERT_EQ(exploration.follow(kRight, true, kLeft), kLeft);    // blocked at once: turn on
  ASSERT_EQ(exploration.follow(kRight, false, kLeft), kForward);
  ASSERT_EQ(exploration.follow(kRight, true, kLeft), kRight);  // blocked half-way: as wished
}

}  // namespace
}  // namespace cmn
