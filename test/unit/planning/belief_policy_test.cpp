// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/belief_policy.hpp"

#include "coarse_map_nav/planning/cost_to_go.hpp"
#include "coarse_map_nav/simulation/range_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kRadius_m = 0.17;
constexpr double kCell_m = 0.4;

LidarParams without_noise() {
  LidarParams lidar;
  lidar.noise_m = 0.0;
  lidar.noise_share = 0.0;
  lidar.dropout = 0.0;
  return lidar;
}

/// A robot without noise on the lattice of its steps, in a building that is not as drawn.
class Journey {
 public:
  Journey(const std::vector<std::string>& drawn, const std::vector<std::string>& built, Cell start,
          Heading heading, Cell goal)
      : drawing_{ascii_map(drawn, kCell_m)},
        world_{ascii_map(built, kCell_m)},
        cost_{drawing_, goal},
        goal_{goal} {
    const Point2 p = drawing_.center_of(start);
    T_world_robot = {p.x, p.y, yaw(heading)};
  }

  /// The robot knows where it is, or is as sure of the place that is off_cells from there.
  Belief known() const {
    Belief belief{drawing_.width(), drawing_.height()};
    belief.set_weight(heading(), cell() + off_cells, 1.0);
    belief.normalise();
    return belief;
  }
  /// Looks; what is returned is good until the next look.
  Situation look(const Belief& belief, double confidence) {
    local_ = projector_.project(sensor_.measure(world_, T_world_robot, 0.0));
    Situation situation{
        drawing_, belief, cost_,
        Estimate{heading(), cell() + off_cells, belief(heading(), cell() + off_cells)}};
    situation.position_cells =
        (1.0 / kCell_m) * T_world_robot.position() + middle_of(off_cells) - middle_of({0, 0});
    situation.yaw_rad = T_world_robot.yaw;
    situation.goal_cells = middle_of(goal_);
    situation.confidence = confidence;
    situation.is_converged = confidence > 0.5;
    situation.is_stuck = is_stuck_;
    situation.local_map = &local_;
    situation.looks = looks;
    policy.look(situation);
    return situation;
  }
  ActionType act(const Situation& situation) {
    const ActionType action = policy.choose(situation, rng_);
    const bool is_step = action == ActionType::kMoveForward;
    const Pose2 T_then =
        T_world_robot * Pose2{is_step ? kCmnStep_m : 0.0, 0.0, quarter_turns(action) * kPi / 2.0};
    is_stuck_ = is_step && !world_.is_disc_free(T_then.position(), kRadius_m);
    stuck += is_stuck_;
    if (!is_stuck_) {
      T_world_robot = T_then;
    }
    return action;
  }
  /// Actions until the policy calls itself as near as can be in the goal's cell; `most` when it
  /// does not.
  int actions_to_goal(int most) {
    for (int i = 0; i < most; ++i) {
      const Belief belief = known();
      const Situation situation = look(belief, 1.0);
      if (policy.is_as_near_as_can_be() && off_goal_m() < kCell_m) {
        return i;
      }
      act(situation);
    }
    return most;
  }
  double off_goal_m() const { return norm(T_world_robot.position() - drawing_.center_of(goal_)); }
  Cell cell() const { return drawing_.cell_of(T_world_robot.position()); }
  Heading heading() const { return nearest_heading(T_world_robot.yaw); }
  const CoarseMap& drawing() const { return drawing_; }

  Pose2 T_world_robot;
  Cell off_cells{0, 0};
  BeliefPolicy policy{LatticeParams{}, MapRepairParams{}, kCmnStep_m, true};
  int stuck = 0;
  const ExpectedLooks* looks = nullptr;

 private:
  CoarseMap drawing_;
  World world_;
  CostToGo cost_;
  Cell goal_;
  RangeSensor sensor_{without_noise(), 1};
  RangeProjector projector_{ProjectionParams{80, 8.0, 0.0}};
  LocalOccupancy local_;
  std::mt19937_64 rng_{1};
  bool is_stuck_ = false;
};

std::vector<std::string> room() {
  std::vector<std::string> rows(10, "#..........#");
  rows.front() = rows.back() = "############";
  return rows;
}

/// A wall between two rooms with a door in the north and one in the south.
std::vector<std::string> rooms(bool has_north_door, bool has_south_door) {
  std::vector<std::string> rows(13, "#......#......#");
  rows.front() = rows.back() = "###############";
  const std::string door = "#.............#";
  for (const std::size_t i : {std::size_t{2}, std::size_t{3}}) {
    rows[i] = has_north_door ? door : rows[i];
    rows[12 - i] = has_south_door ? door : rows[12 - i];
  }
  return rows;
}

TEST(BeliefPolicy, DoesNotTurnForEver) {
  // Whichever way it has turned, the better way lies to the left again.
  Journey journey{room(), room(), {6, 2}, Heading::kEast, {6, 8}};
  int turns = 0;
  int most_turns = 0;
  int steps = 0;
  for (int i = 0; i < 30; ++i) {
    const Belief belief = journey.known();
    const bool is_step = journey.act(journey.look(belief, 1.0)) == ActionType::kMoveForward;
    steps += is_step;
    turns = is_step ? 0 : turns + 1;
    most_turns = std::max(most_turns, turns);
    journey.T_world_robot.yaw = 0.0;
  }
  EXPECT_GE(steps, 4);
  EXPECT_LE(most_turns, 5);
  EXPECT_GE(most_turns, 4) << "turning round once is no fault";
}

TEST(BeliefPolicy, DrivesToTheGoalAndSaysSo) {
  for (const Heading heading : kHeadings) {
    for (const Cell goal : {Cell{10, 8}, Cell{1, 7}, Cell{9, 1}, Cell{2, 2}}) {
      SCOPED_TRACE(std::to_string(goal.x) + " " + std::to_string(goal.y));
      Journey journey{room(), room(), {2, 2}, heading, goal};
      const double way_m = std::abs(journey.T_world_robot.x - journey.drawing().center_of(goal).x) +
                           std::abs(journey.T_world_robot.y - journey.drawing().center_of(goal).y);
      EXPECT_LE(journey.actions_to_goal(100), way_m / kCmnStep_m + 8.0);
      EXPECT_LE(journey.off_goal_m(), 0.3);
      EXPECT_EQ(journey.stuck, 0);
    }
  }
}

TEST(BeliefPolicy, FindsTheWayRoundWhenADrawnDoorIsBlocked) {
  Journey journey{rooms(true, true), rooms(false, true), {3, 9}, Heading::kEast, {11, 9}};
  EXPECT_LE(journey.actions_to_goal(250), 150);  // 4.8 m + 2 * 2.8 m: 70 steps and some looks
  EXPECT_LE(journey.off_goal_m(), 0.3);
  const RepairedMap& map = *journey.policy.repaired_map();
  EXPECT_TRUE(map.is_open(map.part_of({7.5, 3.0})));
}

TEST(BeliefPolicy, TakesADoorThatTheDrawingLacks) {
  Journey journey{rooms(false, true), rooms(true, true), {3, 9}, Heading::kEast, {11, 9}};
  EXPECT_LE(journey.actions_to_goal(250), 45);  // 3.2 m straight on
  EXPECT_LE(journey.off_goal_m(), 0.3);
}

TEST(BeliefPolicy, ExpectsToCrossAWallWhenNothingElseIsLeft) {
  Journey journey{rooms(false, false), rooms(true, false), {3, 6}, Heading::kEast, {11, 6}};
  EXPECT_LE(journey.actions_to_goal(250), 150);
  EXPECT_LE(journey.off_goal_m(), 0.3);
}

TEST(BeliefPolicy, WhatItLearnedAtAWrongPlaceDoesNotStay) {
  Journey journey{rooms(true, false), rooms(true, false), {3, 3}, Heading::kEast, {11, 3}};
  // It is sure to be 1.6 m farther north, before the door: but there is a wall.
  journey.off_cells = {0, 4};
  for (int i = 0; i < 40; ++i) {
    const Belief belief = journey.known();
    journey.act(journey.look(belief, 1.0));
  }
  const RepairedMap& map = *journey.policy.repaired_map();
  const Cell door = map.part_of({7.5, 10.0});
  EXPECT_FALSE(map.is_open(door));
  journey.off_cells = {0, 0};
  const Belief belief = journey.known();
  journey.look(belief, 1.0);
  EXPECT_TRUE(map.is_open(door));
  EXPECT_LE(journey.actions_to_goal(250), 70);  // 2.8 m + 2.4 m + 2.8 m: 54 steps and turns
  EXPECT_LE(journey.off_goal_m(), 0.3);
}

TEST(BeliefPolicy, ExploresWhileItKnowsNothing) {
  Journey journey{rooms(true, true), rooms(true, true), {3, 6}, Heading::kEast, {11, 6}};
  const Belief flat = Belief::uniform(journey.drawing());
  std::set<std::pair<int, int>> been;
  for (int i = 0; i < 100; ++i) {
    ASSERT_NE(journey.act(journey.look(flat, 0.0)), ActionType::kStop);
    been.insert({journey.cell().x, journey.cell().y});
  }
  EXPECT_GE(been.size(), 10U);
  EXPECT_EQ(journey.stuck, 0);
  // And learns nothing meanwhile: it does not know where.
  const RepairedMap& map = *journey.policy.repaired_map();
  EXPECT_TRUE(
      is_same_drawing(map.as_map(), RepairedMap{journey.drawing(), MapRepairParams{}}.as_map()));
}

TEST(BeliefPolicy, GoesWhereAllHypothesesAgree) {
  // In one of two places, at one heading: the goal lies east of both.
  Journey journey{room(), room(), {2, 4}, Heading::kNorth, {10, 4}};
  Belief belief{12, 10};
  belief.set_weight(Heading::kNorth, {2, 4}, 0.5);
  belief.set_weight(Heading::kNorth, {4, 4}, 0.5);
  belief.normalise();
  EXPECT_EQ(journey.act(journey.look(belief, 0.5)), ActionType::kTurnRight);
}

/// Two poses look different where the first of them is in these columns.
class LooksOfColumns : public ExpectedLooks {
 public:
  LooksOfColumns(double from, double to) : from_{from}, to_{to} {}
  std::vector<double> apart(const std::vector<GridPose>& poses, double /*scale*/) const override {
    const double x = poses.front().position_cells.x;
    return std::vector<double>(poses.size() * (poses.size() - 1) / 2,
                               x >= from_ && x < to_ ? 5.0 : 0.0);
  }

 private:
  double from_;
  double to_;
};

/// How far to the east it drives in a corridor that looks the same 4 m farther on; the goal is in
/// the middle between the two places, so that to stay would be best [cells].
int driven_east(const ExpectedLooks* looks) {
  const std::string wall(40, '#');
  const std::string corridor = "#" + std::string(38, '.') + "#";
  const std::vector<std::string> rows{wall, corridor, corridor, corridor, wall};
  Journey journey{rows, rows, {14, 2}, Heading::kEast, {19, 2}};
  journey.looks = looks;
  for (int i = 0; i < 12; ++i) {
    Belief belief{40, 5};
    belief.set_weight(journey.heading(), journey.cell(), 0.5);
    belief.set_weight(journey.heading(), journey.cell() + Cell{10, 0}, 0.5);
    belief.normalise();
    journey.act(journey.look(belief, 0.5));
  }
  return journey.cell().x - 14;
}

TEST(BeliefPolicy, DrivesToWhereLookAlikePlacesDiffer) {
  const LooksOfColumns in_the_east{17.0, 40.0};
  const LooksOfColumns in_the_west{0.0, 12.0};
  EXPECT_GE(driven_east(&in_the_east), 3);
  EXPECT_LE(driven_east(&in_the_west), -2);
}

TEST(BeliefPolicy, AfterAStepThatEndedBlockedItDoesAnother) {
  Journey journey{room(), room(), {2, 4}, Heading::kEast, {10, 4}};
  const Belief belief = journey.known();
  Situation situation = journey.look(belief, 1.0);
  situation.is_stuck = true;
  journey.policy.look(situation);
  EXPECT_NE(journey.act(situation), ActionType::kMoveForward);
  const RepairedMap& map = *journey.policy.repaired_map();
  const Cell ahead = map.part_of({2.5 + 0.34 / kCell_m, 4.5});
  EXPECT_FALSE(map.is_open(ahead));
  journey.policy.reset();
  EXPECT_TRUE(map.is_open(ahead));
}

TEST(BeliefPolicy, TellsTheWayThatIsLeft) {
  Journey journey{room(), room(), {2, 4}, Heading::kEast, {10, 4}};
  const Belief belief = journey.known();
  const Situation situation = journey.look(belief, 1.0);
  EXPECT_NEAR(journey.policy.distance_to_go_m(situation).value(), 8 * kCell_m, 0.25);
}

TEST(BeliefPolicy, AGoalWhereNoMiddleOfARobotCanBeIsAsFarAsItIs) {
  // A pillar that is not drawn stands beside the goal.
  std::vector<std::string> built = room();
  built[5] = "#.......#..#";
  Journey journey{room(), built, {5, 4}, Heading::kEast, {7, 4}};
  for (int i = 0; i < 4; ++i) {
    const Belief belief = journey.known();
    const Situation situation = journey.look(belief, 1.0);
    EXPECT_LE(journey.policy.distance_to_go_m(situation).value(), 1.2) << i;
  }
  const RepairedMap& map = *journey.policy.repaired_map();
  EXPECT_FALSE(map.is_open(map.part_of({7.5, 4.5})));
}

TEST(BeliefPolicy, WithoutALocalMapItSaysSo) {
  Journey journey{room(), room(), {2, 4}, Heading::kEast, {10, 4}};
  const Belief belief = journey.known();
  Situation situation = journey.look(belief, 1.0);
  situation.local_map = nullptr;
  EXPECT_THROW(journey.policy.look(situation), std::invalid_argument);
}

}  // namespace
}  // namespace cmn
