// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/planner.hpp"

#include <cmath>
#include <limits>

#include "ascii_map.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using testing::HasSubstr;

Belief certain(const CoarseMap& map, const Estimate& estimate) {
  Belief belief{map.width(), map.height()};
  belief.set_weight(estimate.heading, estimate.cell, 1.0);
  belief.normalise();
  return belief;
}

/// A planner on a map of 0.5 m cells, asked about a robot that knows where it is.
class PlannerTest : public testing::Test {
 protected:
  Decision decide_at(Heading heading, Cell cell, bool is_blocked_ahead = false) {
    const Estimate estimate{heading, cell, 1.0};
    return planner_.decide({certain(map_, estimate), estimate, middle_of(estimate.cell),
                            yaw(estimate.heading), 1.0, true},
                           is_blocked_ahead);
  }
  CoarseMap map_ = ascii_map(
      {
          "#######",
          "#..#..#",
          "#..#.##",
          "#....##",
          "####.##",
          "#.#####",
          "#######",
      },
      0.5);
  PlanningParams params_;
  Planner planner_{map_, params_};
};

TEST_F(PlannerTest, RefusesAGoalOutsideTheDrawingAndSaysWhatToDo) {
  const auto reason = planner_.set_goal({9.0, 2.75});
  ASSERT_TRUE(reason);
  EXPECT_EQ(*reason,
            "Goal (9.00, 2.75) m lies outside the drawing, which is 3.50 m x 3.50 m with its lower "
            "left corner at (0.00, 0.00) m; the nearest cell that can be one is (5, 5) at (2.75, "
            "2.75) m.");
  EXPECT_FALSE(planner_.goal());
}

TEST_F(PlannerTest, RefusesAnOccupiedGoalAndNamesTheNearestFreeCell) {
  const auto reason = planner_.set_goal({1.8, 2.2});
  ASSERT_TRUE(reason);
  EXPECT_EQ(
      *reason,
      "Goal (1.80, 2.20) m lies in cell (3, 4), which is occupied on the drawing; the nearest "
      "cell that can be one is (4, 4) at (2.25, 2.25) m.");
}

TEST_F(PlannerTest, RefusesAWalledInGoal) {
  const auto reason = planner_.set_goal({0.75, 0.75});
  ASSERT_TRUE(reason);
  EXPECT_THAT(*reason, HasSubstr("cell (1, 1), which is walled in on all four sides; the nearest"));
}

TEST_F(PlannerTest, RefusesGoalsThatAreNoPointsOrTooFarForACell) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const Point2 p : {Point2{kNan, 1.0}, Point2{1.0, kInf}, Point2{1e300, 0.0},
                         Point2{-1e-9, 1.0}, Point2{3.5, 1.0}}) {
    EXPECT_TRUE(planner_.set_goal(p)) << p.x << ", " << p.y;
  }
}

TEST_F(PlannerTest, SaysSoWhenNoCellOfTheDrawingCanBeAGoal) {
  Planner planner{ascii_map({"#.#"}), params_};
  EXPECT_THAT(*planner.set_goal({1.5, 0.5}), HasSubstr("no cell of this drawing can be one"));
}

TEST_F(PlannerTest, ARefusedGoalLeavesTheOldOne) {
  ASSERT_FALSE(planner_.set_goal({0.75, 2.75}));
  ASSERT_TRUE(planner_.set_goal({9.0, 9.0}));
  EXPECT_EQ(planner_.goal(), (Cell{1, 5}));
}

TEST_F(PlannerTest, TakesAGoalInTheFrameOfATurnedMap) {
  Planner planner{ascii_map({"...", "..."}, 1.0, {10.0, 5.0, kPi / 2.0}), params_};
  ASSERT_FALSE(planner.set_goal({9.5, 7.5}));
  EXPECT_EQ(planner.goal(), (Cell{2, 0}));
}

TEST_F(PlannerTest, StandsStillWithoutAGoal) {
  const Decision decision = decide_at(Heading::kEast, {1, 5});
  EXPECT_EQ(decision.state, NavigationState::kStopped);
  EXPECT_EQ(decision.action.type, ActionType::kStop);
  EXPECT_TRUE(std::isnan(decision.distance_to_go_m));
  EXPECT_EQ(decision.text, "No goal is set.");
  EXPECT_TRUE(planner_.path_from({1, 5}).empty());
}

TEST_F(PlannerTest, NavigatesOnceConverged) {
  ASSERT_FALSE(planner_.set_goal({2.25, 2.75}));
  const Decision decision = decide_at(Heading::kSouth, {2, 5});
  EXPECT_EQ(decision.state, NavigationState::kNavigating);
  EXPECT_EQ(decision.action.type, ActionType::kMoveForward);
  EXPECT_EQ(decision.action.distance_m, params_.step_m);
  EXPECT_DOUBLE_EQ(decision.distance_to_go_m, 3.0);
  EXPECT_EQ(decision.text, "3.0 m to go, forward.");
  EXPECT_EQ(planner_.path_from({2, 5}).size(), 7U);
  EXPECT_EQ(planner_.actions(), 1);
}

TEST_F(PlannerTest, LocalizesUntilConverged) {
  ASSERT_FALSE(planner_.set_goal({2.25, 2.75}));
  const Belief belief = Belief::uniform(map_);
  const Decision decision = planner_.decide(
      {belief, Estimate{Heading::kEast, {4, 5}, 0.02}, {4.5, 5.5}, 0.0, 0.07, false}, true);
  EXPECT_EQ(decision.state, NavigationState::kLocalizing) << "though the estimate is the goal";
  EXPECT_NE(decision.action.type, ActionType::kStop);
  EXPECT_NE(decision.action.type, ActionType::kMoveForward);
  EXPECT_THAT(decision.text, HasSubstr("confidence 7 %"));
  EXPECT_THAT(decision.text, HasSubstr("blocked"));
}

TEST_F(PlannerTest, ReachesTheGoalOnceAndStaysThere) {
  ASSERT_FALSE(planner_.set_goal({2.25, 2.75}));
  ASSERT_EQ(decide_at(Heading::kNorth, {4, 4}).state, NavigationState::kNavigating);
  const Decision reached = decide_at(Heading::kNorth, {4, 5});
  EXPECT_EQ(reached.state, NavigationState::kReached);
  EXPECT_EQ(reached.action.type, ActionType::kStop);
  EXPECT_EQ(reached.distance_to_go_m, 0.0);
  EXPECT_THAT(reached.text, HasSubstr("cell (4, 5) with 1 actions"));
  EXPECT_EQ(decide_at(Heading::kNorth, {1, 5}).state, NavigationState::kReached);
  EXPECT_EQ(planner_.actions(), 1);
  ASSERT_FALSE(planner_.set_goal({2.25, 2.75}));
  EXPECT_EQ(decide_at(Heading::kNorth, {1, 5}).state, NavigationState::kNavigating);
  planner_.cancel_goal();
  EXPECT_EQ(decide_at(Heading::kNorth, {1, 5}).state, NavigationState::kStopped);
}

TEST_F(PlannerTest, ReachesTheGoalWithinTheToleranceButNotThroughAWall) {
  params_.goal_tolerance_m = 1.0;
  planner_ = Planner{map_, params_};
  ASSERT_FALSE(planner_.set_goal({2.25, 2.75}));
  // 1 m away beyond the wall, by 7 cells of path.
  EXPECT_EQ(decide_at(Heading::kEast, {2, 5}).state, NavigationState::kNavigating);
  EXPECT_EQ(decide_at(Heading::kNorth, {4, 2}).state, NavigationState::kNavigating);
  EXPECT_EQ(decide_at(Heading::kNorth, {4, 3}).state, NavigationState::kReached);
}

TEST_F(PlannerTest, DoesNotTrustAnUnsureEstimateAtTheGoal) {
  ASSERT_FALSE(planner_.set_goal({2.25, 2.75}));
  const Estimate estimate{Heading::kEast, {4, 5}, 0.3};
  const Belief belief = certain(map_, estimate);
  EXPECT_EQ(
      planner_
          .decide({belief, estimate, middle_of(estimate.cell), yaw(estimate.heading), 0.49, true},
                  false)
          .state,
      NavigationState::kNavigating);
  EXPECT_EQ(
      planner_
          .decide({belief, estimate, middle_of(estimate.cell), yaw(estimate.heading), 0.9, false},
                  false)
          .state,
      NavigationState::kLocalizing);
  EXPECT_EQ(
      planner_
          .decide({belief, estimate, middle_of(estimate.cell), yaw(estimate.heading), 0.5, true},
                  false)
          .state,
      NavigationState::kReached);
}

TEST_F(PlannerTest, GivesUpAfterMaxActions) {
  params_.max_actions = 3;
  planner_ = Planner{map_, params_};
  ASSERT_FALSE(planner_.set_goal({2.25, 2.75}));
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(decide_at(Heading::kEast, {1, 5}).state, NavigationState::kNavigating);
  }
  const Decision decision = decide_at(Heading::kEast, {1, 5});
  EXPECT_EQ(decision.state, NavigationState::kFailed);
  EXPECT_EQ(decision.action.type, ActionType::kStop);
  EXPECT_EQ(decision.text,
            "Gave up after 3 actions (max_actions), by the estimate 3.5 m before the goal.");
}

TEST_F(PlannerTest, ReachesTheGoalWithTheLastAction) {
  params_.max_actions = 1;
  planner_ = Planner{map_, params_};
  ASSERT_FALSE(planner_.set_goal({2.25, 2.75}));
  ASSERT_EQ(decide_at(Heading::kNorth, {4, 4}).state, NavigationState::kNavigating);
  EXPECT_EQ(decide_at(Heading::kNorth, {4, 5}).state, NavigationState::kReached);
}

TEST_F(PlannerTest, ExploresFromAnEstimateWithNoWayWhileItMayBeElsewhere) {
  ASSERT_FALSE(planner_.set_goal({2.25, 2.75}));
  const Estimate estimate{Heading::kEast, {1, 1}, 0.9};
  Belief belief{map_.width(), map_.height()};
  belief.set_weight(Heading::kEast, {1, 1}, 0.9);
  belief.set_weight(Heading::kEast, {1, 5}, 0.1);
  ASSERT_TRUE(belief.normalise());
  const Decision decision = planner_.decide(
      {belief, estimate, middle_of(estimate.cell), yaw(estimate.heading), 0.9, true}, false);
  EXPECT_EQ(decision.state, NavigationState::kLocalizing);
  EXPECT_TRUE(std::isnan(decision.distance_to_go_m));
  EXPECT_THAT(decision.text,
              HasSubstr("no way leads to the goal from the estimate at cell (1, 1)"));
}

TEST_F(PlannerTest, FailsWhereverTheRobotMayBeThereIsNoWay) {
  ASSERT_FALSE(planner_.set_goal({2.25, 2.75}));
  const Decision decision = decide_at(Heading::kEast, {1, 1});
  EXPECT_EQ(decision.state, NavigationState::kFailed);
  EXPECT_THAT(decision.text, HasSubstr("No way on the drawing leads to the goal at cell (4, 5)"));
}

TEST_F(PlannerTest, TheSameSeedDecidesTheSame) {
  Planner other{map_, params_};
  ASSERT_FALSE(planner_.set_goal({2.25, 2.75}));
  ASSERT_FALSE(other.set_goal({2.25, 2.75}));
  const Belief belief = Belief::uniform(map_);
  const Localization flat{belief, Estimate{Heading::kEast, {4, 5}, 0.02}, {4.5, 5.5}, 0.0, 0.07,
                          false};
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(planner_.decide(flat, i % 3 == 0).action.type,
              other.decide(flat, i % 3 == 0).action.type);
  }
}

TEST_F(PlannerTest, LookingRoundIsNoActionOfTheJourneyAndTeachesNothingAboutTheWayAhead) {
  EXPECT_EQ(planner_.look_round(0.0).action.type, ActionType::kStop) << "without a goal";
  params_.max_actions = 1;
  planner_ = Planner{map_, params_};
  ASSERT_FALSE(planner_.set_goal({2.25, 2.75}));
  const Decision forward = decide_at(Heading::kEast, {1, 3});
  planner_.action_ended(MotionOutcome::kBlocked);
  for (int pivot = 1; pivot <= 4; ++pivot) {
    const Decision turn = planner_.look_round(0.2);
    EXPECT_EQ(turn.action.type, ActionType::kTurnLeft);
    EXPECT_EQ(turn.action.axes_yaw_rad, 0.2);
    EXPECT_TRUE(turn.is_pivot);
    EXPECT_EQ(planner_.pivots(), pivot);
    planner_.action_ended(MotionOutcome::kSucceeded);
  }
  EXPECT_EQ(planner_.actions(), 1);
  EXPECT_FALSE(forward.is_pivot);
}

}  // namespace
}  // namespace cmn
