// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/motion/motion_controller.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kPeriod_s = 0.02;
constexpr double kDegree = kPi / 180.0;
constexpr double kFree = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const Action kForward{ActionType::kMoveForward, 0.5};
const Action kLeft{ActionType::kTurnLeft, 0.0};
const Action kRight{ActionType::kTurnRight, 0.0};
const Action kStop{ActionType::kStop, 0.0};

/// A controller and a base that does at once, and exactly, what it is told.
class MotionControllerTest : public testing::Test {
 protected:
  std::optional<MotionResult> tick(bool obstacle = false, bool collided = false) {
    const MotionStep step = controller_.step(now_, obstacle ? 0.0 : kFree, collided);
    command_ = step.command;
    now_.stamp_s += kPeriod_s;
    now_.T_odom_robot = now_.T_odom_robot * Pose2{command_.linear_mps * kPeriod_s, 0.0,
                                                  command_.angular_radps * kPeriod_s};
    return step.result;
  }
  void run_for(double seconds) {
    for (double t = 0.0; t < seconds; t += kPeriod_s) {
      ASSERT_FALSE(tick());
    }
  }
  /// The next result, or none within 20 s.
  std::optional<MotionResult> run(bool obstacle = false) {
    for (double t = 0.0; t < 20.0; t += kPeriod_s) {
      if (const auto result = tick(obstacle)) {
        return result;
      }
    }
    return std::nullopt;
  }
  bool commands_zero() const { return command_.linear_mps == 0.0 && command_.angular_radps == 0.0; }

  MotionController controller_{MotionParams{}};
  OdometrySample now_{10.0, {}};
  VelocityCommand command_;
};

TEST_F(MotionControllerTest, StandsStillWithoutAnAction) {
  EXPECT_TRUE(controller_.is_idle());
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(tick());
    EXPECT_TRUE(commands_zero());
  }
  EXPECT_FALSE(controller_.check_silence(1000.0));
}

TEST_F(MotionControllerTest, DrivesForwardAndSaysHowFar) {
  controller_.start(7, kForward, now_);
  EXPECT_FALSE(controller_.is_idle());
  const auto result = run();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->action_id, 7U);
  EXPECT_EQ(result->outcome, MotionOutcome::kSucceeded);
  EXPECT_NEAR(result->T_start_end.x, 0.5, 0.01);
  EXPECT_NEAR(result->T_start_end.y, 0.0, 0.001);
  EXPECT_TRUE(controller_.is_idle());
  EXPECT_TRUE(commands_zero());
}

TEST_F(MotionControllerTest, TurnsToTheExactAxisAndNotByAQuarterTurn) {
  now_.T_odom_robot.yaw = 10.0 * kDegree;
  controller_.start(1, kLeft, now_);
  const auto result = run();
  ASSERT_TRUE(result);
  EXPECT_NEAR(now_.T_odom_robot.yaw, 90.0 * kDegree, 0.5 * kDegree);
  EXPECT_NEAR(result->T_start_end.yaw, 80.0 * kDegree, 0.5 * kDegree);
}

TEST_F(MotionControllerTest, TurnsAcrossTheSeamAtHalfATurn) {
  for (const double start_deg : {89.0, 91.0, 179.0, -179.0, 180.0, -91.0}) {
    for (const Action& action : {kLeft, kRight}) {
      SCOPED_TRACE(std::to_string(start_deg));
      now_.stamp_s += 100.0;
      now_.T_odom_robot = {0.0, 0.0, start_deg * kDegree};
      controller_.start(1, action, now_);
      const auto result = run();
      ASSERT_TRUE(result);
      EXPECT_EQ(result->outcome, MotionOutcome::kSucceeded);
      EXPECT_NEAR(result->T_start_end.yaw, quarter_turns(action.type) * kPi / 2.0, 1.6 * kDegree);
      EXPECT_NEAR(residual_yaw(now_.T_odom_robot), 0.0, 0.5 * kDegree);
    }
  }
}

TEST_F(MotionControllerTest, TurnsToTheAxisBeforeItDrives) {
  now_.T_odom_robot.yaw = -30.0 * kDegree;
  controller_.start(1, kForward, now_);
  const auto result = run();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->outcome, MotionOutcome::kSucceeded);
  EXPECT_NEAR(now_.T_odom_robot.x, 0.5, 0.01);
  EXPECT_NEAR(now_.T_odom_robot.y, 0.0, 0.01);
  EXPECT_NEAR(now_.T_odom_robot.yaw, 0.0, 0.5 * kDegree);
}

TEST_F(MotionControllerTest, DoesNotMoveAtAllWhenItBeginsBlocked) {
  now_.T_odom_robot.yaw = 20.0 * kDegree;  // nor does it turn to the axis
  const OdometrySample start = now_;
  controller_.start(1, kForward, now_);
  std::optional<MotionResult> result;
  for (int i = 0; i < 20 && !result; ++i) {
    result = tick(true);
    EXPECT_TRUE(commands_zero());
  }
  ASSERT_TRUE(result);
  EXPECT_EQ(result->outcome, MotionOutcome::kBlocked);
  EXPECT_EQ(now_.T_odom_robot.yaw, start.T_odom_robot.yaw);
  EXPECT_EQ(result->T_start_end.x, 0.0);
}

TEST_F(MotionControllerTest, StopsWithinOneStepOnAnObstacleAndOnACollision) {
  for (const bool collision : {false, true}) {
    controller_.start(1, kForward, now_);
    run_for(0.8);
    ASSERT_GT(command_.linear_mps, 0.2);
    const double x = now_.T_odom_robot.x;
    EXPECT_FALSE(tick(!collision, collision)) << "it ends when the base stands still, not before";
    EXPECT_TRUE(commands_zero());
    const auto result = run();
    ASSERT_TRUE(result);
    EXPECT_EQ(result->outcome, MotionOutcome::kBlocked);
    EXPECT_NEAR(now_.T_odom_robot.x, x, 1e-9) << "once blocked it does not drive on";
  }
}

TEST_F(MotionControllerTest, CountsWhatTheBaseStillRollsAfterAnObstacle) {
  controller_.start(1, kForward, now_);
  run_for(0.8);
  const double x = now_.T_odom_robot.x;
  tick(true);
  for (int i = 0; i < 5; ++i) {  // a real base needs a moment
    now_.T_odom_robot.x += 0.004;
    EXPECT_FALSE(tick(true));
  }
  const auto result = run(true);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->T_start_end.x, x + 0.02, 1e-9);
}

TEST_F(MotionControllerTest, IsBlockedWhenTheWayIsClearForLessThanTheRestOfTheStep) {
  controller_.start(1, kForward, now_);
  std::optional<MotionResult> result;
  // It may drive up to a wall just at the end of its way.
  while (!result && now_.stamp_s < 30.0) {
    const MotionStep step = controller_.step(now_, 0.5 - now_.T_odom_robot.x, false);
    result = step.result;
    now_.stamp_s += kPeriod_s;
    now_.T_odom_robot.x += step.command.linear_mps * kPeriod_s;
  }
  ASSERT_TRUE(result);
  EXPECT_EQ(result->outcome, MotionOutcome::kSucceeded);
  for (const double clear_m : {0.4, kNan}) {
    SCOPED_TRACE(clear_m);
    controller_.start(2, kForward, now_);
    const double x = now_.T_odom_robot.x;
    result.reset();
    for (int i = 0; i < 50 && !result; ++i) {
      const MotionStep step = controller_.step(now_, clear_m, false);
      EXPECT_EQ(step.command.linear_mps, 0.0) << "it does not set out";
      result = step.result;
      now_.stamp_s += kPeriod_s;
    }
    ASSERT_TRUE(result);
    EXPECT_EQ(result->outcome, MotionOutcome::kBlocked);
    EXPECT_EQ(now_.T_odom_robot.x, x);
  }
}

TEST_F(MotionControllerTest, KeepsToTheAxesThatTheActionNames) {
  // The odometry has drifted: the building's axes lie at 25 degrees in it.
  const double axes = 25.0 * kDegree;
  now_.T_odom_robot.yaw = 20.0 * kDegree;
  controller_.start(1, {ActionType::kMoveForward, 0.5, axes}, now_);
  ASSERT_TRUE(run());
  EXPECT_NEAR(now_.T_odom_robot.yaw, axes, 0.5 * kDegree);
  EXPECT_NEAR(now_.T_odom_robot.x, 0.5 * std::cos(axes), 0.02);
  EXPECT_NEAR(now_.T_odom_robot.y, 0.5 * std::sin(axes), 0.02);
  now_.T_odom_robot.yaw += 4.0 * kDegree;
  controller_.start(2, {ActionType::kTurnLeft, 0.0, axes}, now_);
  ASSERT_TRUE(run());
  EXPECT_NEAR(now_.T_odom_robot.yaw, axes + kPi / 2.0, 0.5 * kDegree);
  controller_.start(3, {ActionType::kTurnRight, 0.0, axes}, now_);
  ASSERT_TRUE(run());
  EXPECT_NEAR(now_.T_odom_robot.yaw, axes, 0.5 * kDegree);
}

TEST_F(MotionControllerTest, ABaseWhoseOdometryDriftsEndsAlongTheAxesFollowed) {
  // Counts 3 % of every turn too much: without the axes, 20 turns one way lose 54 degrees.
  double true_yaw = 0.0;
  for (std::uint32_t id = 1; id <= 20; ++id) {
    SCOPED_TRACE(id);
    const double axes = now_.T_odom_robot.yaw - true_yaw;  // as a compass has it
    controller_.start(id, {ActionType::kTurnLeft, 0.0, axes}, now_);
    std::optional<MotionResult> result;
    for (double t = 0.0; t < 20.0 && !result; t += kPeriod_s) {
      const MotionStep step = controller_.step(now_, kFree, false);
      result = step.result;
      now_.stamp_s += kPeriod_s;
      true_yaw += step.command.angular_radps * kPeriod_s;
      now_.T_odom_robot.yaw =
          wrap_angle(now_.T_odom_robot.yaw + 1.03 * step.command.angular_radps * kPeriod_s);
    }
    ASSERT_TRUE(result);
    EXPECT_NEAR(wrap_angle(true_yaw - id * kPi / 2.0), 0.0, 4.0 * kDegree);
  }
}

TEST_F(MotionControllerTest, PivotsBesideAnObstacle) {
  controller_.start(1, kLeft, now_);
  const auto result = run(true);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->outcome, MotionOutcome::kSucceeded);
}

TEST_F(MotionControllerTest, SucceedsWhenTheObstacleAppearsAtTheEndOfTheWay) {
  controller_.start(1, kForward, now_);
  std::optional<MotionResult> result;
  for (int i = 0; i < 1000 && !result; ++i) {
    result = tick(now_.T_odom_robot.x > 0.495);
  }
  ASSERT_TRUE(result);
  EXPECT_EQ(result->outcome, MotionOutcome::kSucceeded);
}

TEST_F(MotionControllerTest, BrakesAnActionThatIsPreemptedAndThenBeginsTheNext) {
  controller_.start(1, kForward, now_);
  run_for(0.8);
  ASSERT_GT(command_.linear_mps, 0.2);
  EXPECT_FALSE(controller_.start(2, kLeft, now_));
  tick();
  EXPECT_GT(command_.linear_mps, 0.2) << "no jolt";
  const auto first = run();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->action_id, 1U);
  EXPECT_EQ(first->outcome, MotionOutcome::kPreempted);
  EXPECT_NEAR(first->T_start_end.x, now_.T_odom_robot.x, 1e-9);
  const auto second = run();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->action_id, 2U);
  EXPECT_EQ(second->outcome, MotionOutcome::kSucceeded);
  EXPECT_NEAR(second->T_start_end.x, 0.0, 1e-9) << "it began from rest";
}

TEST_F(MotionControllerTest, StopOnlyEndsTheActionUnderWay) {
  controller_.start(1, kForward, now_);
  run_for(0.8);
  EXPECT_FALSE(controller_.start(2, kStop, now_));
  const auto result = run();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->action_id, 1U);
  EXPECT_EQ(result->outcome, MotionOutcome::kPreempted);
  EXPECT_TRUE(controller_.is_idle());
  EXPECT_FALSE(controller_.start(3, kStop, now_));
  EXPECT_TRUE(controller_.is_idle());
}

TEST_F(MotionControllerTest, ReportsAnOrderThatIsReplacedBeforeItBegan) {
  controller_.start(1, kForward, now_);
  run_for(0.8);
  EXPECT_FALSE(controller_.start(2, kLeft, now_));
  const auto replaced = controller_.start(3, kRight, now_);
  ASSERT_TRUE(replaced);
  EXPECT_EQ(replaced->action_id, 2U);
  EXPECT_EQ(replaced->outcome, MotionOutcome::kPreempted);
  EXPECT_EQ(replaced->T_start_end.x, 0.0);
  EXPECT_EQ(run()->action_id, 1U);
  EXPECT_EQ(run()->action_id, 3U);
}

TEST_F(MotionControllerTest, AnObstacleStopsAtOnceEvenWhileItBrakes) {
  controller_.start(1, kForward, now_);
  run_for(0.8);
  controller_.start(2, kForward, now_);
  tick();
  ASSERT_GT(command_.linear_mps, 0.0);
  tick(true);
  EXPECT_TRUE(commands_zero());
  const auto first = run(true);
  EXPECT_EQ(first->outcome, MotionOutcome::kPreempted);
  EXPECT_TRUE(commands_zero());
  const double x = now_.T_odom_robot.x;
  EXPECT_EQ(run(true)->outcome, MotionOutcome::kBlocked);
  EXPECT_EQ(now_.T_odom_robot.x, x);
}

TEST_F(MotionControllerTest, TimesOutWhenTheBaseDoesNotObey) {
  controller_.start(1, kForward, now_);
  std::optional<MotionResult> result;
  double seconds = 0.0;
  for (; !result && seconds < 30.0; seconds += kPeriod_s) {
    result = controller_.step(now_, kFree, false).result;
    now_.stamp_s += kPeriod_s;
  }
  ASSERT_TRUE(result);
  EXPECT_EQ(result->outcome, MotionOutcome::kTimedOut);
  EXPECT_GT(seconds, 15.0);
  EXPECT_LT(seconds, 16.5);
}

TEST_F(MotionControllerTest, TimesOutWhileSomebodyCarriesTheRobotAbout) {
  controller_.start(1, kLeft, now_);
  std::optional<MotionResult> result;
  double seconds = 0.0;
  for (; !result && seconds < 30.0; seconds += kPeriod_s) {
    result = controller_.step(now_, kFree, false).result;
    now_.stamp_s += kPeriod_s;
    now_.T_odom_robot.yaw = wrap_angle(now_.T_odom_robot.yaw - 0.02);
  }
  ASSERT_TRUE(result);
  EXPECT_EQ(result->outcome, MotionOutcome::kTimedOut);
  EXPECT_LT(seconds, 18.0);
}

TEST_F(MotionControllerTest, EndsWhenOdometryFallsSilent) {
  controller_.start(4, kForward, now_);
  run_for(0.8);
  const double last_s = now_.stamp_s - kPeriod_s;
  EXPECT_FALSE(controller_.check_silence(last_s + 0.35));
  const auto result = controller_.check_silence(last_s + 0.45);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->action_id, 4U);
  EXPECT_EQ(result->outcome, MotionOutcome::kTimedOut);
  EXPECT_GT(result->T_start_end.x, 0.05);
  EXPECT_TRUE(controller_.is_idle());
  now_.stamp_s += 5.0;
  EXPECT_FALSE(tick());
  EXPECT_TRUE(commands_zero()) << "odometry that comes back does not restart anything";
}

TEST_F(MotionControllerTest, SilenceAlsoEndsTheOrderThatWaits) {
  controller_.start(1, kForward, now_);
  run_for(0.8);
  controller_.start(2, kLeft, now_);
  EXPECT_EQ(controller_.check_silence(now_.stamp_s + 1.0)->action_id, 1U);
  const auto second = controller_.check_silence(now_.stamp_s + 1.0);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->action_id, 2U);
  EXPECT_EQ(second->outcome, MotionOutcome::kTimedOut);
  EXPECT_TRUE(controller_.is_idle());
}

TEST_F(MotionControllerTest, StopsWhenTimeRunsBackwards) {
  controller_.start(1, kForward, now_);
  run_for(0.8);
  const double x = now_.T_odom_robot.x;
  now_ = {1.0, {}};  // the bag began again
  const auto result = tick();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->outcome, MotionOutcome::kTimedOut);
  EXPECT_NEAR(result->T_start_end.x, x, 0.01) << "up to the last good sample";
  EXPECT_TRUE(commands_zero());
  controller_.start(2, kForward, now_);
  EXPECT_EQ(run()->outcome, MotionOutcome::kSucceeded) << "and works on in the new time";
}

TEST_F(MotionControllerTest, StopsWhenOdometryJumps) {
  controller_.start(1, kForward, now_);
  run_for(0.8);
  controller_.start(2, kLeft, now_);
  now_.T_odom_robot = {5.0, -3.0, 1.0};
  const auto result = tick();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->outcome, MotionOutcome::kTimedOut);
  EXPECT_LT(result->T_start_end.x, 0.5);
  EXPECT_TRUE(commands_zero());
  const auto second = run();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->outcome, MotionOutcome::kTimedOut) << "what waited was decided before the jump";
  EXPECT_EQ(second->T_start_end.yaw, 0.0);
}

TEST_F(MotionControllerTest, StopsOnAPoseThatIsNotANumber) {
  controller_.start(1, kForward, now_);
  run_for(0.8);
  const OdometrySample good = now_;
  now_.T_odom_robot.yaw = kNan;
  const MotionStep step = controller_.step(now_, kFree, false);
  ASSERT_TRUE(step.result);
  EXPECT_EQ(step.result->outcome, MotionOutcome::kTimedOut);
  EXPECT_TRUE(std::isfinite(step.result->T_start_end.x));
  EXPECT_EQ(step.command.linear_mps, 0.0);
  now_ = good;
  controller_.start(2, kForward, {kNan, {kNan, kNan, kNan}});
  const auto result = run();
  ASSERT_TRUE(result);
  EXPECT_TRUE(std::isfinite(result->T_start_end.x));
}

TEST_F(MotionControllerTest, LivesThroughAShortGapInTheOdometry) {
  controller_.start(1, kForward, now_);
  run_for(0.6);
  const double before = command_.linear_mps;
  now_.stamp_s += 0.4;
  now_.T_odom_robot.x += 0.4 * before;
  EXPECT_FALSE(tick());
  EXPECT_LE(std::abs(command_.linear_mps - before), 0.05 + 1e-9) << "0.1 s worth of ramp";
}

TEST_F(MotionControllerTest, AForwardStepOfNoLengthEndsWhereItIs) {
  controller_.start(1, {ActionType::kMoveForward, 0.0}, now_);
  const auto result = run(true);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->outcome, MotionOutcome::kSucceeded);
  EXPECT_EQ(now_.T_odom_robot.x, 0.0);
}

TEST(ActionCheck, RefusesATypeThatIsNone) {
  EXPECT_FALSE(is_executable({static_cast<ActionType>(4), 0.0}));
  EXPECT_FALSE(is_executable({static_cast<ActionType>(255), 0.0}));
}

TEST(ActionCheck, RefusesDistancesThatNobodyCanDrive) {
  EXPECT_TRUE(is_executable(kForward));
  EXPECT_TRUE(is_executable({ActionType::kTurnLeft, kNan})) << "a turn has no distance";
  EXPECT_FALSE(is_executable({ActionType::kMoveForward, -0.1}));
  EXPECT_FALSE(is_executable({ActionType::kMoveForward, kNan}));
  EXPECT_FALSE(is_executable({ActionType::kMoveForward, std::numeric_limits<double>::infinity()}));
}

}  // namespace
}  // namespace cmn
