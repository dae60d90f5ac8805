// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/simulation/step_drive.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ascii_map.hpp"
#include "simulated_drive.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr Action kForward{ActionType::kMoveForward, kCmnStep_m};
constexpr Action kLeft{ActionType::kTurnLeft, 0.0};
constexpr Action kRight{ActionType::kTurnRight, 0.0};

/// A base that errs by the ends of its actions only (3 mm, 3 mrad).
RobotParams exact() {
  RobotParams params;
  params.travel_noise = params.wheel_slip = params.turn_noise = 0.0;
  params.travel_bias = params.turn_bias = 0.0;
  return params;
}

/// 6 m x 2 m, a wall at x = 5.
World corridor() { return World{ascii_map({".....#", ".....#"})}; }

TEST(StepDrive, GoesForwardAndTurnsByAnAction) {
  const World world = corridor();
  StepDrive robot{world, exact(), {1.0, 1.0, 0.0}, 1};
  EXPECT_EQ(robot.carry_out(kForward), MotionOutcome::kSucceeded);
  EXPECT_NEAR(robot.truth().x, 1.15, 0.02);
  EXPECT_NEAR(robot.truth().y, 1.0, 0.02);
  EXPECT_EQ(robot.carry_out(kLeft), MotionOutcome::kSucceeded);
  EXPECT_NEAR(robot.truth().yaw, kPi / 2, 0.03);
  EXPECT_EQ(robot.carry_out(kRight), MotionOutcome::kSucceeded);
  EXPECT_NEAR(robot.truth().yaw, 0.0, 0.03);
  EXPECT_NEAR(robot.driven_m(), 0.15, 0.02);
  EXPECT_EQ(robot.collisions(), 0);
}

TEST(StepDrive, OdometryBeginsAtTheStartPoseWhateverThatIs) {
  const World world = corridor();
  StepDrive robot{world, exact(), {1.0, 1.0, kPi / 2}, 1};
  EXPECT_EQ(robot.T_odom_robot().x, 0.0);
  EXPECT_EQ(robot.T_odom_robot().yaw, 0.0);
  robot.carry_out(kForward);
  EXPECT_NEAR(robot.T_odom_robot().x, 0.15, 0.02);
  EXPECT_NEAR(robot.truth().y, 1.15, 0.02);
}

TEST(StepDrive, StandingIsNoMotion) {
  const World world = corridor();
  StepDrive robot{world, RobotParams{}, {1.0, 1.0, 0.3}, 1};
  EXPECT_EQ(robot.carry_out({}), MotionOutcome::kSucceeded);
  EXPECT_EQ(robot.truth().x, 1.0);
  EXPECT_EQ(robot.truth().yaw, 0.3);
  EXPECT_EQ(robot.driven_m(), 0.0);
}

TEST(StepDrive, ACollisionStopsItAtTheContactAndOdometryDoesNotCountOn) {
  const World world = corridor();
  RobotParams params = exact();
  StepDrive robot{world, params, {4.7, 1.0, 0.0}, 1};
  EXPECT_EQ(robot.carry_out(kForward), MotionOutcome::kBlocked);
  EXPECT_NEAR(robot.truth().x, 5.0 - params.radius_m, 0.003);
  EXPECT_NEAR(robot.T_odom_robot().x, robot.truth().x - 4.7, 0.01);
  EXPECT_EQ(robot.collisions(), 1);
  EXPECT_EQ(robot.carry_out(kForward), MotionOutcome::kBlocked);
  EXPECT_EQ(robot.collisions(), 2);
  EXPECT_NEAR(robot.truth().x, 5.0 - params.radius_m, 0.003);
  EXPECT_NEAR(robot.driven_m(), robot.truth().x - 4.7, 0.003);
}

TEST(StepDrive, SlidesAlongAWallButDoesNotPushThroughIt) {
  const World world = corridor();
  RobotParams params = exact();
  params.sliding = true;
  const double wall_y = 2.0 - params.radius_m;
  StepDrive robot{world, params, {1.0, wall_y - 0.01, 0.5}, 1};
  EXPECT_EQ(robot.carry_out(kForward), MotionOutcome::kSucceeded);
  EXPECT_NEAR(robot.truth().y, wall_y, 0.003);
  EXPECT_NEAR(robot.truth().x, 1.0 + 0.15 * std::cos(0.5), 0.02);
  EXPECT_EQ(robot.collisions(), 1);
  params.sliding = false;
  StepDrive stopped{world, params, {1.0, wall_y - 0.01, 0.5}, 1};
  EXPECT_EQ(stopped.carry_out(kForward), MotionOutcome::kBlocked);
  EXPECT_LT(stopped.truth().x, 1.04);
}

TEST(StepDrive, SlidingIsBlockedWhereItHardlyGetsAhead) {
  const World world = corridor();
  RobotParams params = exact();
  params.sliding = true;
  StepDrive robot{world, params, {5.0 - params.radius_m - 0.01, 1.0, 0.1}, 1};
  EXPECT_EQ(robot.carry_out(kForward), MotionOutcome::kBlocked);
  EXPECT_EQ(robot.carry_out(kForward), MotionOutcome::kBlocked);
  EXPECT_LE(robot.truth().x, 5.0 - params.radius_m + 1e-9);
}

TEST(StepDrive, NeverStandsInAnObstacleAndIsTheSameForTheSameSeed) {
  const World world{ascii_map({"..#..", ".....", "#...#", "..#.."})};
  for (const bool sliding : {false, true}) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      RobotParams params;
      params.sliding = sliding;
      std::array<StepDrive, 2> robots{StepDrive{world, params, {2.5, 2.5, 0.0}, seed},
                                      StepDrive{world, params, {2.5, 2.5, 0.0}, seed}};
      for (StepDrive& robot : robots) {
        std::mt19937_64 rng{seed};
        for (int i = 0; i < 200; ++i) {
          const double lot = draw_uniform(rng);
          robot.carry_out(lot < 0.7 ? kForward : lot < 0.85 ? kLeft : kRight);
          ASSERT_TRUE(world.is_disc_free(robot.truth().position(), params.radius_m - 1e-6));
        }
      }
      EXPECT_EQ(robots[0].truth().x, robots[1].truth().x);
      EXPECT_EQ(robots[0].T_odom_robot().yaw, robots[1].T_odom_robot().yaw);
    }
  }
}

TEST(StepDrive, CanBeKidnappedButNotIntoAWall) {
  const World world = corridor();
  StepDrive robot{world, exact(), {1.0, 1.0, 0.0}, 1};
  robot.carry_out(kForward);
  const Pose2 T_odom_robot = robot.T_odom_robot();
  robot.set_truth({3.0, 1.0, kPi});
  EXPECT_EQ(robot.truth().x, 3.0);
  EXPECT_EQ(robot.T_odom_robot().x, T_odom_robot.x);
  EXPECT_THROW(robot.set_truth({4.95, 1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW((StepDrive{world, exact(), {5.5, 1.0, 0.0}, 1}), std::invalid_argument);
}

/// How far off a number of robots are, each way.
struct Errors {
  std::vector<Pose2> samples;

  double deviation(double Pose2::*coordinate) const {
    double sum = 0.0;
    double squares = 0.0;
    for (const Pose2& sample : samples) {
      sum += sample.*coordinate;
      squares += sample.*coordinate * (sample.*coordinate);
    }
    const auto n = static_cast<double>(samples.size());
    return std::sqrt(squares / n - (sum / n) * (sum / n));
  }
  double mean(double Pose2::*coordinate) const {
    double sum = 0.0;
    for (const Pose2& sample : samples) {
      sum += sample.*coordinate;
    }
    return sum / static_cast<double>(samples.size());
  }
};

TEST(StepDrive, ErrsAsTheWholeSimulationDoes) {
  // 100 actions, N = 100 robots each: a standard deviation is known to 7 %, so that two of them
  // differ by 10 % by chance. Measured with N = 200, simulation and steps: the truth errs by 0.069
  // and 0.076 m in x, 0.247 and 0.257 m in y, 0.078 and 0.080 rad; odometry by 0.071 and 0.071 m,
  // 0.246 and 0.257 m, 0.078 and 0.080 rad. On average the simulated base ends 0.1 m off after 70
  // steps (it stops some millimetres late), which odometry counts.
  constexpr int kRobots = 100;
  const World world = empty_hall(60.0);
  std::vector<Action> actions;
  std::mt19937_64 rng{7};
  Pose2 T_start_ideal;
  for (int i = 0; i < 100; ++i) {
    const double lot = draw_uniform(rng);
    actions.push_back(lot < 0.7 ? kForward : lot < 0.85 ? kLeft : kRight);
    T_start_ideal = T_start_ideal * Pose2{actions.back().distance_m, 0.0,
                                          quarter_turns(actions.back().type) * kPi / 2};
  }
  const Pose2 T_world_start{30.0, 30.0, 0.0};
  // Of the truth against the orders, and of odometry against the truth.
  std::array<Errors, 2> of_truth;
  std::array<Errors, 2> of_odometry;
  const auto note = [&](std::size_t which, const Pose2& truth, const Pose2& odometry) {
    const Pose2 T_start_robot = inverse(T_world_start) * truth;
    of_truth[which].samples.push_back(inverse(T_start_ideal) * T_start_robot);
    of_odometry[which].samples.push_back(inverse(T_start_robot) * odometry);
  };
  for (std::uint32_t seed = 0; seed < kRobots; ++seed) {
    SimulationParams params;
    Simulator simulator{world, params, T_world_start, seed};
    SimulatedDrive drive{simulator, MotionParams{}};
    StepDrive robot{world, params.robot, T_world_start, seed};
    for (const Action& action : actions) {
      drive.run(action);
      robot.carry_out(action);
    }
    note(0, simulator.truth(), simulator.odometry().T_odom_robot);
    note(1, robot.truth(), robot.T_odom_robot());
  }
  for (const auto& [name, errors] :
       {std::pair{"truth", &of_truth}, std::pair{"odometry", &of_odometry}}) {
    for (const auto& [axis, coordinate] :
         {std::pair{"x", &Pose2::x}, std::pair{"y", &Pose2::y}, std::pair{"yaw", &Pose2::yaw}}) {
      const double whole = (*errors)[0].deviation(coordinate);
      const double step = (*errors)[1].deviation(coordinate);
      EXPECT_NEAR(step / whole, 1.0, 0.3) << name << " " << axis;
      EXPECT_NEAR((*errors)[0].mean(coordinate), (*errors)[1].mean(coordinate), 0.2)
          << name << " " << axis;
    }
  }
}

}  // namespace
}  // namespace cmn
