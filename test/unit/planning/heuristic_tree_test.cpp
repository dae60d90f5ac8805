// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/heuristic_tree.hpp"

#include "coarse_map_nav/planning/cost_to_go.hpp"

#include <array>
#include <string>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr auto kForward = ActionType::kMoveForward;
constexpr auto kLeft = ActionType::kTurnLeft;
constexpr auto kRight = ActionType::kTurnRight;

TEST(ActionTree, TakesTheDirectionOfTheHeuristicAtAnyDepth) {
  for (int depth = 2; depth <= 6; ++depth) {
    SCOPED_TRACE("depth " + std::to_string(depth));
    const ActionTree tree{depth};
    std::mt19937_64 rng{1};
    for (int i = 0; i < 20; ++i) {
      ASSERT_EQ(tree.choose({1, 0}, true, rng), kForward);
      ASSERT_EQ(tree.choose({0, 1}, true, rng), kLeft);
      ASSERT_EQ(tree.choose({0, -1}, true, rng), kRight);
      ASSERT_NE(tree.choose({-1, 0}, true, rng), kForward);
    }
  }
}

TEST(ActionTree, BreaksTiesByChanceOnlyAmongTheFewestTurns) {
  const ActionTree tree{2};
  std::mt19937_64 rng{1};
  std::array<int, 4> count{};
  for (int i = 0; i < 1000; ++i) {
    // The goal is behind: leaves left and right have cosine 0 and one turn, as good as each other.
    ++count[static_cast<std::size_t>(tree.choose({-1, 0}, true, rng))];
    // To a diagonal, two steps ahead and none to turn beat a turn and a step.
    ASSERT_EQ(tree.choose({1, 1}, true, rng), kForward);
  }
  EXPECT_EQ(count[static_cast<std::size_t>(kForward)], 0);
  EXPECT_NEAR(count[static_cast<std::size_t>(kLeft)], 500, 60);
}

TEST(ActionTree, ALeafThatGoesNowhereIsNeitherGoodNorBad) {
  const ActionTree tree{2};
  std::mt19937_64 rng{1};
  // No h: all cosines are 0, so the leaf with no turns wins.
  EXPECT_EQ(tree.choose({0, 0}, true, rng), kForward);
}

TEST(ActionTree, NeverBeginsForwardWhenItMayNot) {
  for (int depth = 2; depth <= 4; ++depth) {
    const ActionTree tree{depth};
    std::mt19937_64 rng{7};
    for (const Cell h : {Cell{1, 0}, Cell{1, 1}, Cell{0, 1}, Cell{-1, 0}, Cell{0, 0}}) {
      for (int i = 0; i < 20; ++i) {
        ASSERT_NE(tree.choose(h, false, rng), kForward);
      }
    }
    EXPECT_EQ(tree.choose({1, 1}, false, rng), kLeft)
        << "the way ahead on the left is blocked ahead";
  }
}

TEST(HeuristicTree, TurnsTheHeuristicIntoTheRobotsFrame) {
  const CoarseMap map = ascii_map({
      "...",
      "...",
      "...",
  });
  const Belief belief = Belief::uniform(map);
  const CostToGo cost{map, {2, 1}};  // due east of the estimate
  for (const bool diagonals : {false, true}) {
    HeuristicTree policy{2, diagonals, 0.1};
    std::mt19937_64 rng{1};
    const auto choose = [&](Heading heading) {
      policy.reset();
      return policy.choose({map, belief, cost, Estimate{heading, {1, 1}, 1.0}}, rng);
    };
    EXPECT_EQ(choose(Heading::kEast), kForward);
    EXPECT_EQ(choose(Heading::kSouth), kLeft);
    EXPECT_EQ(choose(Heading::kNorth), kRight);
    EXPECT_NE(choose(Heading::kWest), kForward);
  }
}

TEST(HeuristicTree, ActsOnTheEstimateHoweverUncertain) {
  const CoarseMap map = ascii_map({"..."});
  const Belief belief = Belief::uniform(map);
  const CostToGo cost{map, {2, 0}};
  HeuristicTree policy{2, false, 1.0};
  std::mt19937_64 rng{1};
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(policy.choose({map, belief, cost, Estimate{Heading::kEast, {0, 0}, 0.1}}, rng),
              kForward);
  }
}

TEST(HeuristicTree, WandersWhereTheEstimateHasNoWay) {
  const CoarseMap map = ascii_map({"..#.."});
  const Belief belief = Belief::uniform(map);
  const CostToGo cost{map, {0, 0}};
  for (const bool diagonals : {false, true}) {
    HeuristicTree policy{2, diagonals, 0.0};
    std::mt19937_64 rng{1};
    Situation situation{map, belief, cost, Estimate{Heading::kEast, {3, 0}, 1.0}, {3.5, 0.5}};
    EXPECT_EQ(policy.choose(situation, rng), kForward);
    situation.is_blocked_ahead = true;
    EXPECT_NE(policy.choose(situation, rng), kForward);
  }
}

}  // namespace
}  // namespace cmn
