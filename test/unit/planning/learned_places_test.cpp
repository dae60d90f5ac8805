// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/learned_places.hpp"

#include <string>
#include <vector>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kStep_m = 0.25;
constexpr double kCellsPerM = 2.0;  // the drawing's cells are 0.5 m

/// A robot that marks where it stands, so that it shows what is held.
class Marker {
 public:
  /// True when what the map holds is of another belief than before.
  bool arrive(Point2 position_cells, double yaw_rad = 0.0) {
    return places.arrive(map, position_cells, yaw_rad, kCellsPerM);
  }
  void mark(int x) { map.mark_failed({x, 0}); }
  bool is_marked(int x) const { return !map.is_open({x, 0}); }
  void drive(int steps) {
    for (int i = 0; i < steps; ++i) {
      places.moved(ActionType::kMoveForward, kStep_m);
    }
  }

  RepairedMap map{ascii_map({std::string(40, '.')}, 0.2), MapRepairParams{}};
  LearnedPlaces places;
};

TEST(LearnedPlaces, HoldsWhatWasLearnedWhileTheEstimateGoesAsTheRobotDoes) {
  Marker robot;
  EXPECT_FALSE(robot.arrive({10.0, 10.0}));
  robot.mark(1);
  robot.drive(8);  // 2 m: 4 cells
  EXPECT_FALSE(robot.arrive({14.0, 10.0}));
  robot.places.moved(ActionType::kTurnLeft, kStep_m);
  EXPECT_FALSE(robot.arrive({14.0, 10.0}, kPi / 2.0));
  robot.drive(8);
  EXPECT_FALSE(robot.arrive({14.0, 14.0}, kPi / 2.0));
  EXPECT_TRUE(robot.is_marked(1));
}

TEST(LearnedPlaces, AJumpSetsAsideWhatWasLearnedAndAJumpBackTakesItUp) {
  Marker robot;
  robot.arrive({10.0, 10.0});
  robot.mark(1);
  robot.drive(4);
  EXPECT_TRUE(robot.arrive({20.0, 10.0}));
  EXPECT_FALSE(robot.is_marked(1));
  robot.mark(2);
  robot.drive(4);
  EXPECT_TRUE(robot.arrive({14.0, 10.0}));
  EXPECT_TRUE(robot.is_marked(1));
  EXPECT_FALSE(robot.is_marked(2));
  EXPECT_TRUE(robot.arrive({22.0, 10.0}));
  EXPECT_TRUE(robot.is_marked(2));
}

TEST(LearnedPlaces, TheSamePlaceTurnedIsAnother) {
  Marker robot;
  robot.arrive({10.0, 10.0});
  robot.places.moved(ActionType::kTurnRight, kStep_m);
  EXPECT_FALSE(robot.arrive({10.0, 10.0}, 1.5 * kPi + 0.5));
  EXPECT_TRUE(robot.arrive({10.0, 10.0}, 0.0));
}

TEST(LearnedPlaces, AnEstimateMaySlideAndAStuckStepIsNone) {
  Marker robot;
  robot.arrive({10.0, 10.0});
  robot.drive(8);
  for (int i = 0; i < 8; ++i) {
    robot.places.was_stuck(kStep_m);
  }
  EXPECT_FALSE(robot.arrive({11.9, 10.0}));  // 0.95 m
  robot.drive(40);                           // 10 m, which the count may have wrong by one more
  EXPECT_FALSE(robot.arrive({35.7, 10.0}));
  robot.drive(40);
  EXPECT_TRUE(robot.arrive({60.0, 10.0}));
}

TEST(LearnedPlaces, WhoeverMovedTheRobotBetweenGoalsItKeepsWhatItKnows) {
  Marker robot;
  robot.arrive({10.0, 10.0});
  robot.mark(1);
  robot.places.expect_anywhere();
  EXPECT_FALSE(robot.arrive({30.0, 10.0}));
  EXPECT_TRUE(robot.is_marked(1));
  EXPECT_TRUE(robot.arrive({10.0, 10.0}));
}

TEST(LearnedPlaces, KeepsAFewAndForgetsTheOldest) {
  Marker robot;
  for (int i = 0; i <= static_cast<int>(LearnedPlaces::kMostSetAside) + 1; ++i) {
    robot.arrive({10.0 * i, 0.0});
    robot.mark(i);
  }
  EXPECT_TRUE(robot.arrive({10.0, 0.0}));
  EXPECT_TRUE(robot.is_marked(1));
  EXPECT_TRUE(robot.arrive({0.0, 0.0}));
  EXPECT_FALSE(robot.is_marked(0));
}

TEST(LearnedPlaces, FailuresThatWereSetAsideAreForgottenToo) {
  Marker robot;
  robot.arrive({10.0, 10.0});
  robot.mark(1);
  robot.arrive({20.0, 10.0});
  robot.places.forget_failures();
  EXPECT_TRUE(robot.arrive({10.0, 10.0}));
  EXPECT_FALSE(robot.is_marked(1));
}

}  // namespace
}  // namespace cmn
