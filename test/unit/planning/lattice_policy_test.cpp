// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/lattice_policy.hpp"

#include "coarse_map_nav/planning/cost_to_go.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr auto kForward = ActionType::kMoveForward;
constexpr auto kLeft = ActionType::kTurnLeft;
constexpr auto kRight = ActionType::kTurnRight;

/// A hall of 8 x 8 cells of 0.5 m with the goal in its north-east.
class LatticePolicyTest : public testing::Test {
 protected:
  Situation at(Heading heading, Cell cell) {
    Situation situation{map_, belief_, cost_, Estimate{heading, cell, 1.0}};
    situation.position_cells = middle_of(cell);
    situation.yaw_rad = yaw(heading);
    situation.goal_cells = middle_of({6, 6});
    situation.confidence = 1.0;
    situation.is_converged = true;
    situation.local_map = &local_;
    return situation;
  }
  /// Marks what lies within the box of the robot's frame [m] as occupied.
  void obstacle(double x_low, double x_high, double y_low, double y_high) {
    for (int iy = 0; iy < local_.size; ++iy) {
      for (int ix = 0; ix < local_.size; ++ix) {
        const double x = (ix + 0.5 - 0.5 * local_.size) * local_.resolution;
        const double y = (iy + 0.5 - 0.5 * local_.size) * local_.resolution;
        if (x > x_low && x < x_high && y > y_low && y < y_high) {
          local_.occupancy[local_.index_of(ix, iy)] = 1.0F;
        }
      }
    }
  }
  void SetUp() override {
    local_.occupancy.assign(local_.cell_count(), 0.0F);
    local_.confidence.assign(local_.cell_count(), 1.0F);
  }

  CoarseMap map_ = ascii_map(std::vector<std::string>(8, std::string(8, '.')), 0.5);
  Belief belief_ = Belief::uniform(map_);
  CostToGo cost_{map_, {6, 6}};
  LocalOccupancy local_{80, 0.05};
  std::mt19937_64 rng_{1};
  LatticePolicy policy_{LatticeParams{}, kCmnStep_m, 0.1};
};

TEST_F(LatticePolicyTest, GoesStraightToAGoalAhead) {
  EXPECT_EQ(policy_.choose(at(Heading::kEast, {1, 6}), rng_), kForward);
  EXPECT_EQ(policy_.choose(at(Heading::kNorth, {6, 1}), rng_), kForward);
}

TEST_F(LatticePolicyTest, TurnsToAGoalAside) {
  EXPECT_EQ(policy_.choose(at(Heading::kEast, {6, 1}), rng_), kLeft);
  EXPECT_EQ(policy_.choose(at(Heading::kNorth, {1, 6}), rng_), kRight);
  EXPECT_EQ(policy_.choose(at(Heading::kWest, {6, 1}), rng_), kRight);
}

TEST_F(LatticePolicyTest, TurnsAboutForAGoalBehind) {
  EXPECT_NE(policy_.choose(at(Heading::kWest, {1, 6}), rng_), kForward);
}

TEST_F(LatticePolicyTest, LeavesAPostAheadAside) {
  obstacle(0.25, 0.5, -0.1, 0.9);
  EXPECT_EQ(policy_.choose(at(Heading::kEast, {1, 6}), rng_), kRight);
  local_.occupancy.assign(local_.cell_count(), 0.0F);
  obstacle(0.25, 0.5, -0.9, 0.1);
  EXPECT_EQ(policy_.choose(at(Heading::kEast, {1, 6}), rng_), kLeft);
}

TEST_F(LatticePolicyTest, ComesThroughADoorThatTheGuardWouldRefuse) {
  // A door of 0.7 m, seen 0.4 m ahead.
  obstacle(0.4, 0.5, 0.35, 3.0);
  obstacle(0.4, 0.5, -3.0, -0.35);
  Situation situation = at(Heading::kEast, {1, 6});
  situation.is_blocked_ahead = true;
  EXPECT_EQ(policy_.choose(situation, rng_), kForward);
}

TEST_F(LatticePolicyTest, DoesNotRepeatAStepThatEndedBlocked) {
  Situation situation = at(Heading::kEast, {1, 6});
  situation.is_stuck = true;
  EXPECT_NE(policy_.choose(situation, rng_), kForward);
}

TEST_F(LatticePolicyTest, WithoutABeliefItExploresAndNeverIntoAWall) {
  obstacle(0.1, 0.3, -0.5, 0.5);
  Situation situation = at(Heading::kEast, {1, 6});
  situation.is_converged = false;
  for (int i = 0; i < 20; ++i) {
    EXPECT_NE(policy_.choose(situation, rng_), kForward);
  }
}

TEST_F(LatticePolicyTest, FromWhereNoWayLeadsItExplores) {
  const CoarseMap walled = ascii_map({"...#....", "...#...."}, 0.5);
  const CostToGo cost{walled, {6, 0}};
  Situation situation{walled, belief_, cost, Estimate{Heading::kEast, {1, 0}, 1.0}};
  situation.is_converged = true;
  situation.position_cells = middle_of({1, 0});
  situation.local_map = &local_;
  int steps = 0;
  for (int i = 0; i < 50; ++i) {
    steps += policy_.choose(situation, rng_) == kForward;
  }
  EXPECT_GT(steps, 30);  // a random walk with a turn at one step in ten
}

TEST_F(LatticePolicyTest, WithoutALocalMapItSaysSo) {
  Situation situation = at(Heading::kEast, {1, 6});
  situation.local_map = nullptr;
  EXPECT_THROW(policy_.choose(situation, rng_), std::invalid_argument);
}

TEST_F(LatticePolicyTest, DrivesToTheGoalAroundWhatItSees) {
  // On the lattice itself, without noise: from (1, 1) facing west to the goal's cell.
  Pose2 T_map_robot{0.75, 0.75, kPi};
  int actions = 0;
  for (; actions < 80 && map_.cell_of(T_map_robot.position()) != Cell{6, 6}; ++actions) {
    Situation situation =
        at(nearest_heading(T_map_robot.yaw), map_.cell_of(T_map_robot.position()));
    situation.position_cells = (1.0 / map_.resolution()) * T_map_robot.position();
    const ActionType action = policy_.choose(situation, rng_);
    T_map_robot = T_map_robot * Pose2{action == kForward ? kCmnStep_m : 0.0, 0.0,
                                      quarter_turns(action) * kPi / 2};
  }
  // 2.5 m each way in steps of 0.15 m and some turns.
  EXPECT_LE(actions, 40);
}

}  // namespace
}  // namespace cmn
