// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/path_policy.hpp"

#include "coarse_map_nav/planning/cost_to_go.hpp"
#include "coarse_map_nav/planning/planner.hpp"

#include <array>
#include <stdexcept>
#include <string>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr auto kForward = ActionType::kMoveForward;
constexpr auto kLeft = ActionType::kTurnLeft;
constexpr auto kRight = ActionType::kTurnRight;

class PathPolicyTest : public testing::Test {
 protected:
  Situation at(Heading heading, Cell cell, bool is_blocked_ahead = false) const {
    Situation situation{map_, belief_, cost_, Estimate{heading, cell, 1.0}};
    situation.confidence = 1.0;
    situation.is_converged = true;
    situation.is_blocked_ahead = is_blocked_ahead;
    return situation;
  }
  CoarseMap map_ = ascii_map({
      "....",
      ".##.",
      "....",
  });
  Belief belief_ = Belief::uniform(map_);
  CostToGo cost_{map_, {3, 2}};
  std::mt19937_64 rng_{1};
  PathPolicy policy_{0.1};
};

TEST_F(PathPolicyTest, GoesForwardWhereTheFirstCellLiesAhead) {
  EXPECT_EQ(policy_.choose(at(Heading::kEast, {1, 2}), rng_), kForward);
  EXPECT_EQ(policy_.choose(at(Heading::kNorth, {3, 0}), rng_), kForward);
}

TEST_F(PathPolicyTest, TurnsTowardsTheFirstCell) {
  EXPECT_EQ(policy_.choose(at(Heading::kSouth, {1, 2}), rng_), kLeft);
  policy_.reset();
  EXPECT_EQ(policy_.choose(at(Heading::kNorth, {1, 2}), rng_), kRight);
}

TEST_F(PathPolicyTest, PrefersTheShortestPathThatBeginsAhead) {
  EXPECT_EQ(policy_.choose(at(Heading::kEast, {0, 0}), rng_), kForward);
  EXPECT_EQ(policy_.choose(at(Heading::kNorth, {0, 0}), rng_), kForward);
}

TEST_F(PathPolicyTest, TurnsBackOverTheSideThatIsFree) {
  // At (0, 1) heading south, the way leads back north; the left (east) is a wall, as is the right.
  // At (0, 0) heading west the way leads north (right) or back; right is downhill.
  EXPECT_EQ(policy_.choose(at(Heading::kWest, {0, 0}), rng_), kRight);
  policy_.reset();
  // At (3, 0) heading south the way leads back; the left is outside, the right is free.
  EXPECT_EQ(policy_.choose(at(Heading::kSouth, {3, 0}), rng_), kRight);
}

TEST_F(PathPolicyTest, TurnsBackByChanceWhereBothSidesAreAlike) {
  std::array<int, 4> count{};
  for (int i = 0; i < 400; ++i) {
    policy_.reset();
    ++count[static_cast<std::size_t>(policy_.choose(at(Heading::kWest, {2, 2}), rng_))];
  }
  EXPECT_EQ(count[static_cast<std::size_t>(kForward)], 0);
  EXPECT_NEAR(count[static_cast<std::size_t>(kLeft)], 200, 50);
}

TEST_F(PathPolicyTest, LeavesABlockedWayByARandomTurnAndAStep) {
  std::array<int, 4> count{};
  for (int i = 0; i < 400; ++i) {
    policy_.reset();
    ++count[static_cast<std::size_t>(policy_.choose(at(Heading::kEast, {1, 2}, true), rng_))];
    ASSERT_EQ(policy_.choose(at(Heading::kNorth, {1, 2}), rng_), kForward)
        << "though the path says otherwise";
  }
  EXPECT_EQ(count[static_cast<std::size_t>(kForward)], 0);
  EXPECT_NEAR(count[static_cast<std::size_t>(kLeft)], 200, 50);
}

TEST_F(PathPolicyTest, ExploresWhileTheBeliefIsFlat) {
  int forward = 0;
  for (int i = 0; i < 1000; ++i) {
    Situation situation = at(Heading::kSouth, {1, 2});  // a plan would turn left
    situation.is_converged = false;
    forward += policy_.choose(situation, rng_) == kForward;
  }
  EXPECT_NEAR(forward, 909, 40);
}

TEST_F(PathPolicyTest, ExploresAtTheGoalAndWhereThereIsNoWay) {
  PathPolicy straight{0.0};
  EXPECT_EQ(straight.choose(at(Heading::kEast, {3, 2}), rng_), kForward);
  EXPECT_EQ(straight.choose(at(Heading::kEast, {1, 1}), rng_), kForward);
  EXPECT_NE(straight.choose(at(Heading::kEast, {1, 1}, true), rng_), kForward);
}

TEST_F(PathPolicyTest, TheRandomBaselineIsUniformOverWhatIsFree) {
  RandomPolicy policy;
  std::array<int, 4> free{};
  std::array<int, 4> blocked{};
  for (int i = 0; i < 3000; ++i) {
    ++free[static_cast<std::size_t>(policy.choose(at(Heading::kEast, {0, 0}), rng_))];
    ++blocked[static_cast<std::size_t>(policy.choose(at(Heading::kEast, {0, 0}, true), rng_))];
  }
  for (const ActionType type : {kForward, kLeft, kRight}) {
    EXPECT_NEAR(free[static_cast<std::size_t>(type)], 1000, 100);
  }
  EXPECT_EQ(blocked[static_cast<std::size_t>(kForward)], 0);
  EXPECT_NEAR(blocked[static_cast<std::size_t>(kLeft)], 1500, 100);
}

TEST(MakePolicy, KnowsEveryWordOfTheParameterAndNoOther) {
  PlanningParams params;
  for (const char* name : {"random", "heuristic_tree", "path"}) {
    params.policy = name;
    EXPECT_NE(make_policy(params), nullptr) << name;
  }
  params.policy = "astar";
  EXPECT_THROW(make_policy(params), std::invalid_argument);
}

}  // namespace
}  // namespace cmn
