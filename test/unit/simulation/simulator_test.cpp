// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/simulation/simulator.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SimulationParams exact() {
  SimulationParams params;
  params.robot.travel_noise = params.robot.wheel_slip = params.robot.turn_noise = 0.0;
  params.robot.travel_bias = params.robot.turn_bias = params.robot.command_delay_s = 0.0;
  return params;
}

World hall() { return World{ascii_map({"....", "....", "....", "...."})}; }  // 4 m x 4 m

void advance(Simulator& simulator, double seconds, const VelocityCommand& command) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds / 0.02)); ++i) {
    simulator.advance(0.02, command);
  }
}

TEST(Simulator, WakesUpAtTheOriginOfItsOdometryWhateverTheStart) {
  const Simulator simulator{hall(), {}, {1.0, 2.0, 1.3}, 1};
  EXPECT_EQ(simulator.odometry().T_odom_robot.x, 0.0);
  EXPECT_EQ(simulator.odometry().T_odom_robot.yaw, 0.0);
  EXPECT_EQ(simulator.truth().yaw, 1.3);
  EXPECT_EQ(simulator.time_s(), 0.0);
}

TEST(Simulator, RefusesAStartInsideAWallWithTheReason) {
  try {
    Simulator simulator(hall(), {}, {0.1, 2.0, 0.0}, 1);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string{e.what()}.find("(0.1, 2)"), std::string::npos) << e.what();
  }
}

TEST(Simulator, FollowsTheCommandWithinItsAccelerationLimits) {
  Simulator simulator{hall(), exact(), {1.0, 1.0, 0.0}, 1};
  simulator.advance(0.1, {0.3, 0.0});
  EXPECT_NEAR(simulator.velocity().linear_mps, 0.1, 1e-9);
  simulator.advance(0.1, {0.3, 1.0});
  EXPECT_NEAR(simulator.velocity().linear_mps, 0.2, 1e-9);
  EXPECT_NEAR(simulator.velocity().angular_radps, 0.4, 1e-9);
  advance(simulator, 1.0, {100.0, 0.0});
  EXPECT_NEAR(simulator.velocity().linear_mps, 0.7, 1e-9) << "the base's own top speed";
  EXPECT_NEAR(simulator.time_s(), 1.2, 1e-9);
}

TEST(Simulator, ActsOnACommandAfterTheDelay) {
  SimulationParams params = exact();
  params.robot.command_delay_s = 0.1;
  Simulator simulator{hall(), params, {1.0, 1.0, 0.0}, 1};
  simulator.advance(0.1, {0.3, 0.0});
  EXPECT_EQ(simulator.velocity().linear_mps, 0.0);
  simulator.advance(0.05, {0.0, 0.0});
  EXPECT_GT(simulator.velocity().linear_mps, 0.0) << "still on its way: the first command";
}

TEST(Simulator, DrivesAlongItsHeading) {
  Simulator simulator{hall(), exact(), {2.0, 1.0, kPi / 2.0}, 1};
  advance(simulator, 3.0, {0.3, 0.0});
  EXPECT_NEAR(simulator.truth().x, 2.0, 1e-9);
  EXPECT_NEAR(simulator.truth().y - 1.0, 0.3 * 3.0 - 0.045, 0.002);
  EXPECT_NEAR(simulator.odometry().T_odom_robot.x, simulator.truth().y - 1.0, 1e-9);
  EXPECT_NEAR(simulator.driven_m(), simulator.truth().y - 1.0, 1e-9);
}

TEST(Simulator, StopsAtTheWallWithTheBumperOnAndCountsOneCollision) {
  Simulator simulator{hall(), exact(), {3.0, 2.0, 0.0}, 1};
  advance(simulator, 5.0, {0.3, 0.0});
  EXPECT_NEAR(simulator.truth().x, 4.0 - 0.18, 1e-4);
  EXPECT_LE(simulator.truth().x, 4.0 - 0.18);
  EXPECT_TRUE(simulator.bumped());
  EXPECT_EQ(simulator.collisions(), 1);
  EXPECT_NEAR(simulator.odometry().T_odom_robot.x, simulator.truth().x - 3.0, 1e-4)
      << "the wheels stall at the wall";
  advance(simulator, 1.0, {0.0, 0.0});
  EXPECT_TRUE(simulator.bumped()) << "it still leans on the wall";
  advance(simulator, 1.0, {0.0, 1.0});
  EXPECT_FALSE(simulator.bumped()) << "it has turned away";
}

TEST(Simulator, SlidesAlongAWallOnlyWhenAsked) {
  SimulationParams params = exact();
  for (const bool sliding : {false, true}) {
    params.robot.sliding = sliding;
    Simulator simulator{hall(), params, {3.7, 1.0, kPi / 4.0}, 1};
    advance(simulator, 5.0, {0.3, 0.0});
    EXPECT_LE(simulator.truth().x, 4.0 - 0.18);
    if (sliding) {
      EXPECT_GT(simulator.truth().y, 1.7);
    } else {
      EXPECT_NEAR(simulator.truth().y, 1.12, 0.01);
    }
  }
}

TEST(Simulator, TurnsFreelyInContactWithAWall) {
  Simulator simulator{hall(), {}, {3.0, 2.0, 0.0}, 1};
  advance(simulator, 5.0, {0.3, 0.0});
  ASSERT_TRUE(simulator.bumped());
  const double yaw = simulator.truth().yaw;
  advance(simulator, 1.0, {0.0, 1.0});
  EXPECT_GT(wrap_angle(simulator.truth().yaw - yaw), 0.8);
}

TEST(Simulator, TakesACommandThatIsNotANumberForAStop) {
  Simulator simulator{hall(), exact(), {2.0, 2.0, 0.0}, 1};
  advance(simulator, 1.0, {std::nan(""), kInfinity});
  EXPECT_EQ(simulator.truth().x, 2.0);
  EXPECT_EQ(simulator.truth().yaw, 0.0);
}

TEST(Simulator, DoesNotTellTheOdometryOfAKidnapping) {
  Simulator simulator{hall(), exact(), {1.0, 1.0, 0.0}, 1};
  advance(simulator, 1.0, {0.3, 0.0});
  const Pose2 odom = simulator.odometry().T_odom_robot;
  simulator.set_truth({3.0, 3.0, kPi});
  EXPECT_EQ(simulator.truth().x, 3.0);
  EXPECT_EQ(simulator.odometry().T_odom_robot.x, odom.x);
  EXPECT_EQ(simulator.velocity().linear_mps, 0.0);
  EXPECT_THROW(simulator.set_truth({-3.0, 3.0, 0.0}), std::invalid_argument);
}

TEST(Simulator, DoesNotMoveAtRest) {
  Simulator simulator{hall(), {}, {1.0, 1.0, 0.0}, 1};
  advance(simulator, 10.0, {0.0, 0.0});
  EXPECT_EQ(simulator.truth().x, 1.0);
  EXPECT_EQ(simulator.odometry().T_odom_robot.x, 0.0);
}

TEST(Simulator, ShipsParametersThatPassTheirOwnCheck) {
  SimulationParams params;
  ParamTree tree;
  for (const ParamDoc& doc : list_params(params)) {
    EXPECT_TRUE(doc.path.rfind("robot/", 0) == 0 || doc.path.rfind("lidar/", 0) == 0) << doc.path;
  }
  tree["robot/sliding"] = true;
  tree["lidar/dropout_value"] = std::string{"nan"};
  EXPECT_TRUE(load_params(tree, params).empty());
  EXPECT_TRUE(params.robot.sliding);
  tree["lidar/dropout_value"] = std::string{"zero"};
  EXPECT_EQ(load_params(tree, params).size(), 1U);
}

}  // namespace
}  // namespace cmn
