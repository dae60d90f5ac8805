// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
// What must hold for every seed when the controller drives the simulated base.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "simulated_drive.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kDegree = kPi / 180.0;
const Pose2 kMiddle{20.0, 20.0, 0.0};

Action random_action(std::mt19937& rng) {
  const auto type = static_cast<ActionType>(std::uniform_int_distribution<int>{1, 3}(rng));
  return {type, std::uniform_real_distribution<double>{0.05, 1.0}(rng)};
}

double off_axis(const Pose2& T_odom_robot) { return std::abs(residual_yaw(T_odom_robot)); }

// 200 seeds x 8 actions, on bases that answer after 0, 50 or 100 ms. Measured: all 1600 within, the
// worst off by 4.7 mm and 0.49 deg.
TEST(MotionProperty, EveryActionEndsWithinHalfADegreeAndACentimetreOnASlippingBase) {
  double worst_m = 0.0;
  double worst_rad = 0.0;
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 rng{seed};
    SimulationParams params;
    params.robot.command_delay_s = 0.05 * (seed % 3);
    Simulator simulator{empty_hall(40.0), params, kMiddle, seed};
    SimulatedDrive drive{simulator, {}};
    for (int i = 0; i < 8; ++i) {
      const Action action = random_action(rng);
      const OdometrySample before = simulator.odometry();
      const MotionResult result = drive.run(action);
      ASSERT_EQ(result.outcome, MotionOutcome::kSucceeded);
      const Displacement d =
          displacement(before.T_odom_robot, before.T_odom_robot * result.T_start_end);
      ASSERT_EQ(d.quarter_turns, quarter_turns(action.type));
      const double way = action.type == ActionType::kMoveForward ? action.distance_m : 0.0;
      ASSERT_NEAR(d.forward_m, way, 0.01);
      worst_m = std::max(worst_m, std::abs(d.forward_m - way));
      ASSERT_LE(off_axis(simulator.odometry().T_odom_robot), 0.5 * kDegree);
      worst_rad = std::max(worst_rad, off_axis(simulator.odometry().T_odom_robot));
    }
  }
  RecordProperty("worst_mm", std::to_string(1000.0 * worst_m));
  RecordProperty("worst_deg", std::to_string(worst_rad / kDegree));
}

TEST(MotionProperty, EveryCommandKeepsTheSpeedAndAccelerationLimits) {
  const MotionParams params;
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 rng{seed};
    Simulator simulator{empty_hall(40.0), {}, kMiddle, seed};
    SimulatedDrive drive{simulator, params};
    for (std::uint32_t i = 0; i < 8; ++i) {  // orders come at any time: most are preempted
      drive.controller().start(i, random_action(rng), simulator.odometry());
      const int ticks = std::uniform_int_distribution<int>{1, 200}(rng);
      for (int t = 0; t < ticks; ++t) {
        drive.tick();
      }
    }
    VelocityCommand before;
    for (const VelocityCommand& command : drive.commands) {
      ASSERT_LE(std::abs(command.linear_mps), params.max_linear_mps);
      ASSERT_GE(command.linear_mps, 0.0);
      ASSERT_LE(std::abs(command.angular_radps), params.max_angular_radps);
      ASSERT_LE(std::abs(command.linear_mps - before.linear_mps),
                params.linear_acceleration * SimulatedDrive::kPeriod_s + 1e-9);
      ASSERT_LE(std::abs(command.angular_radps - before.angular_radps),
                params.angular_acceleration * SimulatedDrive::kPeriod_s + 1e-9);
      before = command;
    }
  }
}

TEST(MotionProperty, ResultsOfAnyOrdersChainToTheOdometryWithoutAGap) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 rng{seed};
    Simulator simulator{empty_hall(40.0), {}, kMiddle, seed};
    SimulatedDrive drive{simulator, {}};
    Pose2 chained;
    for (std::uint32_t i = 0; i < 8; ++i) {
      if (const auto result =
              drive.controller().start(i, random_action(rng), simulator.odometry())) {
        EXPECT_EQ(result->outcome, MotionOutcome::kPreempted);
        chained = chained * result->T_start_end;
      }
      const int ticks = std::uniform_int_distribution<int>{1, 200}(rng);
      for (int t = 0; t < ticks; ++t) {
        if (const auto result = drive.tick()) {
          chained = chained * result->T_start_end;
        }
      }
    }
    for (int t = 0; t < 2000 && !drive.controller().is_idle(); ++t) {
      if (const auto result = drive.tick()) {
        chained = chained * result->T_start_end;
      }
    }
    ASSERT_TRUE(drive.controller().is_idle());
    const Pose2 odom = simulator.odometry().T_odom_robot;
    // Between actions the base stands still to within 1 mm and 0.1 deg: 8 results, 8 such gaps.
    EXPECT_NEAR(norm(chained.position() - odom.position()), 0.0, 0.008);
    EXPECT_NEAR(wrap_angle(chained.yaw - odom.yaw), 0.0, 0.8 * kDegree);
  }
}

TEST(MotionProperty, FourPivotsAreTheIdentityWithoutNoise) {
  SimulationParams still;
  still.robot.travel_noise = still.robot.wheel_slip = still.robot.turn_noise = 0.0;
  still.robot.travel_bias = still.robot.turn_bias = 0.0;
  for (const Heading heading : kHeadings) {
    for (const ActionType turn : {ActionType::kTurnLeft, ActionType::kTurnRight}) {
      SCOPED_TRACE(std::to_string(index(heading)) + ", " + std::to_string(quarter_turns(turn)));
      Simulator simulator{empty_hall(40.0), still, {20.0, 20.0, yaw(heading)}, 1};
      SimulatedDrive drive{simulator, {}};
      for (int i = 0; i < 4; ++i) {
        drive.run({turn, 0.0});
      }
      const Pose2 end = simulator.truth();
      EXPECT_NEAR(norm(end.position() - Point2{20.0, 20.0}), 0.0, 1e-9);
      EXPECT_NEAR(wrap_angle(end.yaw - yaw(heading)), 0.0, 0.5 * kDegree);
    }
  }
}

// 200 seeds x 4 pivots: the errors of single pivots do not add up in the odometry frame.
TEST(MotionProperty, FourPivotsOnASlippingBaseReturnToTheAxisOfTheOdometry) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Simulator simulator{empty_hall(40.0), {}, kMiddle, seed};
    SimulatedDrive drive{simulator, {}};
    for (int i = 0; i < 4; ++i) {
      drive.run({ActionType::kTurnLeft, 0.0});
    }
    EXPECT_NEAR(simulator.odometry().T_odom_robot.yaw, 0.0, 0.5 * kDegree);
  }
}

TEST(MotionProperty, AnyStartYawEndsOnTheAxisThatIsCountedFromTheNearestOne) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 rng{seed};
    const double start_yaw = std::uniform_real_distribution<double>{-kPi, kPi}(rng);
    const ActionType type = seed % 2 == 0 ? ActionType::kTurnLeft : ActionType::kTurnRight;
    // An exact base, whose odometry begins at any yaw.
    MotionController controller{MotionParams{}};
    OdometrySample now{0.0, {0.0, 0.0, start_yaw}};
    controller.start(1, {type, 0.0}, now);
    std::optional<MotionResult> result;
    while (!result && now.stamp_s < 20.0) {
      const MotionStep step = controller.step(now, kNothingAhead, false);
      result = step.result;
      now.stamp_s += 0.02;
      now.T_odom_robot.yaw = wrap_angle(now.T_odom_robot.yaw + 0.02 * step.command.angular_radps);
    }
    ASSERT_TRUE(result);
    const double target = (nearest_quarter(start_yaw) + quarter_turns(type)) * kPi / 2.0;
    EXPECT_NEAR(wrap_angle(now.T_odom_robot.yaw - target), 0.0, 0.5 * kDegree);
    EXPECT_GT(quarter_turns(type) * result->T_start_end.yaw, 0.0);
  }
}

}  // namespace
}  // namespace cmn
