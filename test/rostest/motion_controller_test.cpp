// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/DiscreteAction.h"
#include "coarse_map_nav/MotionResult.h"
#include "coarse_map_nav/ros/conversions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "ros_graph.hpp"
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float32.h>
#include <topic_tools/shape_shifter.h>

namespace cmn {
namespace {

using coarse_map_nav::DiscreteAction;
using coarse_map_nav::MotionResult;

constexpr double kTick_s = 0.02;
constexpr float kFree = std::numeric_limits<float>::infinity();

/// A motion controller, the base that obeys it and the clock of both.
///
/// The clock goes on only when the node has answered the odometry, or after a while if it has
/// nothing to say: how fast the machine is does not matter.
class MotionControllerTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(wait_for([this] {
      send_clock();
      return odoms_.getNumSubscribers() > 0 && actions_.getNumSubscribers() > 0 &&
             obstacles_.getNumSubscribers() > 0 && commands_.is_connected() &&
             results_.is_connected() && diagnostics_.is_connected();
    })) << node_.output();
  }

  void send_clock() {
    rosgraph_msgs::Clock clock;
    clock.clock = ros::Time{time_s_};
    clocks_.publish(clock);
  }

  nav_msgs::Odometry odometry() const {
    nav_msgs::Odometry odom;
    odom.header.stamp = ros::Time{time_s_};
    odom.header.frame_id = "odom";
    odom.pose.pose = pose_message(pose_);
    return odom;
  }

  /// One tick of the clock: the base moves as it was last told to, then odometry is sent.
  void tick() {
    if (!commands_.empty()) {
      const auto& twist = commands_.back();
      pose_ = pose_ * Pose2{twist.linear.x * kTick_s, 0.0, twist.angular.z * kTick_s};
      top_speed_mps_ = std::max(top_speed_mps_, std::abs(twist.linear.x));
    }
    time_s_ += kTick_s;
    send_clock();
    if (is_guard_awake_) {
      std_msgs::Float32 clear;
      clear.data = clear_ahead_m_;
      obstacles_.publish(clear);
    }
    if (is_odometry_awake_) {
      const std::size_t before = commands_.size();
      odoms_.publish(odometry());
      // A moving base gets a command for each odometry message; waiting for it keeps the clock from
      // running ahead of a node that gets little of the processor.
      wait_for([&] { return commands_.size() > before; }, is_moving() ? 2.0 : 0.02);
    } else {
      wait_for([] { return false; }, 0.005);
    }
  }
  /// Ticks until `holds()`, for at most so long by the test's clock.
  template <class Predicate>
  bool tick_until(Predicate holds, double patience_s = 20.0) {
    const double end_s = time_s_ + patience_s;
    while (!holds() && time_s_ < end_s) {
      tick();
    }
    // The last answer may still be on its way.
    return wait_for(holds);
  }

  /// Goes on until the node has surely heard who is awake: messages of one topic may overtake those
  /// of another. Its diagnostics, once a second, tell how old the last message was.
  void be_heard() {
    const double since_s = time_s_;
    const auto is_heard = [&](const std::string& input) {
      const auto& all = diagnostics_.all();
      return std::any_of(all.begin(), all.end(), [&](const auto& message) {
        const auto age_s =
            diagnosed(*message, "motion_controller: " + input, "age of the last [s]");
        return age_s && message->header.stamp.toSec() - *age_s > since_s;
      });
    };
    ASSERT_TRUE(tick_until([&] {
      time_s_ += 0.1;
      return (!is_odometry_awake_ || is_heard("odom")) &&
             (!is_guard_awake_ || is_heard("clear_ahead"));
    })) << node_.output();
  }

  static DiscreteAction action(std::uint32_t id, std::uint8_t type, double distance_m = 0.15) {
    DiscreteAction message;
    message.id = id;
    message.type = type;
    message.distance = static_cast<float>(distance_m);
    return message;
  }
  bool is_moving() const {
    return !commands_.empty() &&
           (commands_.back().linear.x != 0.0 || commands_.back().angular.z != 0.0);
  }
  /// Orders an action, again until the base moves: without odometry there is no start.
  void start(const DiscreteAction& message) {
    actions_.publish(message);
    ASSERT_TRUE(tick_until([this] { return is_moving(); })) << node_.output();
  }
  bool has_result(std::uint32_t id) const { return !results_.empty() && results_.back().id == id; }
  double drops(const std::string& input) const {
    double sum = 0.0;
    for (const char* reason :
         {"no such action", "there is no odometry yet", "the pose is not a pose"}) {
      sum +=
          diagnosed(diagnostics_, "motion_controller: " + input, std::string("dropped: ") + reason);
    }
    return sum;
  }

  double time_s_ = 100.0;
  Pose2 pose_{1.0, 2.0, 0.0};
  bool is_odometry_awake_ = true;
  bool is_guard_awake_ = true;
  float clear_ahead_m_ = kFree;
  double top_speed_mps_ = 0.0;
  ros::NodeHandle nh_;
  ros::Publisher clocks_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 1);
  ros::Publisher odoms_ = nh_.advertise<nav_msgs::Odometry>("odom", 10);
  ros::Publisher actions_ = nh_.advertise<DiscreteAction>("action", 10);
  ros::Publisher obstacles_ = nh_.advertise<std_msgs::Float32>("clear_ahead", 10);
  Inbox<geometry_msgs::Twist> commands_{"cmd_vel"};
  Inbox<MotionResult> results_{"motion_result"};
  Inbox<diagnostic_msgs::DiagnosticArray> diagnostics_{"/diagnostics"};
  NodeProcess node_{"motion_controller"};
};

TEST_F(MotionControllerTest, DrivesAndTurnsAndSaysWhatWasDriven) {
  be_heard();
  start(action(1, DiscreteAction::MOVE_FORWARD));
  ASSERT_TRUE(tick_until([this] { return has_result(1); })) << node_.output();
  EXPECT_EQ(results_.back().outcome, MotionResult::SUCCEEDED);
  EXPECT_NEAR(results_.back().displacement.x, 0.15, 0.02);
  EXPECT_NEAR(pose_.x, 1.0 + results_.back().displacement.x, 0.01);

  start(action(2, DiscreteAction::TURN_RIGHT));
  ASSERT_TRUE(tick_until([this] { return has_result(2); })) << node_.output();
  EXPECT_EQ(results_.back().outcome, MotionResult::SUCCEEDED);
  EXPECT_NEAR(results_.back().displacement.theta, -kPi / 2.0, 0.02);
  EXPECT_FALSE(is_moving());
}

TEST_F(MotionControllerTest, SilentOdometryStopsTheBaseWithinHalfASecond) {
  be_heard();
  start(action(1, DiscreteAction::MOVE_FORWARD, 2.0));
  is_odometry_awake_ = false;
  wait_for([] { return false; }, 0.2);  // what is on its way arrives before the clock goes on
  const double silent_since_s = time_s_;
  while (time_s_ + kTick_s < silent_since_s + 0.5) {
    tick();
  }
  ASSERT_TRUE(wait_for([this] { return !is_moving() && has_result(1); })) << node_.output();
  EXPECT_EQ(results_.back().outcome, MotionResult::TIMED_OUT);

  is_odometry_awake_ = true;
  be_heard();
  start(action(2, DiscreteAction::TURN_LEFT));
  EXPECT_TRUE(tick_until([this] { return has_result(2); })) << "it does not go on afterwards";
}

TEST_F(MotionControllerTest, OdometryThatIsNoPoseIsAsGoodAsSilent) {
  be_heard();
  start(action(1, DiscreteAction::MOVE_FORWARD, 2.0));
  is_odometry_awake_ = false;
  nav_msgs::Odometry broken = odometry();
  broken.pose.pose.position.x = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(tick_until(
      [&] {
        odoms_.publish(broken);
        return has_result(1);
      },
      2.0));
  EXPECT_EQ(results_.back().outcome, MotionResult::TIMED_OUT);
  ASSERT_TRUE(wait_for([this] { return !is_moving(); }));
  EXPECT_TRUE(std::isfinite(results_.back().displacement.x));
  EXPECT_TRUE(tick_until([&] { return drops("odom") > 0.0; })) << "not counted";
  for (const auto& twist : commands_.all()) {
    ASSERT_TRUE(std::isfinite(twist->linear.x) && std::isfinite(twist->angular.z));
  }
}

TEST_F(MotionControllerTest, OdometryThatJumpsEndsTheAction) {
  be_heard();
  start(action(1, DiscreteAction::MOVE_FORWARD, 2.0));
  pose_ = {};  // the driver of the base was restarted
  ASSERT_TRUE(tick_until([this] { return has_result(1); }, 1.0)) << node_.output();
  EXPECT_EQ(results_.back().outcome, MotionResult::TIMED_OUT);
  EXPECT_LT(std::hypot(results_.back().displacement.x, results_.back().displacement.y), 1.0)
      << "the jump was not driven";
}

TEST_F(MotionControllerTest, TimeThatGoesBackEndsTheActionAndTheNextOneWorks) {
  be_heard();
  start(action(1, DiscreteAction::MOVE_FORWARD, 2.0));
  time_s_ = 20.0;
  ASSERT_TRUE(tick_until([this] { return has_result(1); }, 1.0)) << node_.output();
  EXPECT_EQ(results_.back().outcome, MotionResult::TIMED_OUT);
  start(action(2, DiscreteAction::TURN_LEFT));  // the guard is heard meanwhile
  ASSERT_TRUE(tick_until([this] { return has_result(2); })) << node_.output();
  start(action(3, DiscreteAction::MOVE_FORWARD));
  ASSERT_TRUE(tick_until([this] { return has_result(3); })) << node_.output();
  EXPECT_EQ(results_.back().outcome, MotionResult::SUCCEEDED);
  // The guard was last heard before the jump; its silence must count from then on as well.
  time_s_ = 5.0;
  is_guard_awake_ = false;
  top_speed_mps_ = 0.0;
  for (std::uint32_t id = 4; results_.back().outcome != MotionResult::BLOCKED; ++id) {
    actions_.publish(action(id, DiscreteAction::MOVE_FORWARD));  // may end by the jump itself
    ASSERT_TRUE(tick_until([&] { return has_result(id); })) << node_.output();
    ASSERT_LT(id, 50U) << results_.back();
  }
  EXPECT_EQ(top_speed_mps_, 0.0);
}

TEST_F(MotionControllerTest, NeverMovesForwardWhileTheGuardIsSilentButTurns) {
  is_guard_awake_ = false;
  be_heard();
  actions_.publish(action(1, DiscreteAction::MOVE_FORWARD));
  ASSERT_TRUE(tick_until([this] { return has_result(1); })) << node_.output();
  EXPECT_EQ(results_.back().outcome, MotionResult::BLOCKED);
  EXPECT_EQ(top_speed_mps_, 0.0);
  start(action(2, DiscreteAction::TURN_LEFT));
  ASSERT_TRUE(tick_until([this] { return has_result(2); }));
  EXPECT_EQ(results_.back().outcome, MotionResult::SUCCEEDED);
}

TEST_F(MotionControllerTest, StopsWhenTheGuardFallsSilentOrSeesAnObstacleOnTheWay) {
  be_heard();
  start(action(1, DiscreteAction::MOVE_FORWARD, 5.0));
  is_guard_awake_ = false;
  ASSERT_TRUE(tick_until([this] { return has_result(1); }, 3.0)) << node_.output();
  EXPECT_EQ(results_.back().outcome, MotionResult::BLOCKED);
  is_guard_awake_ = true;
  be_heard();
  start(action(2, DiscreteAction::MOVE_FORWARD, 5.0));
  clear_ahead_m_ = 0.0F;
  ASSERT_TRUE(tick_until([this] { return has_result(2); }, 3.0)) << node_.output();
  EXPECT_EQ(results_.back().outcome, MotionResult::BLOCKED);
  EXPECT_FALSE(is_moving());
}

TEST_F(MotionControllerTest, ABumperStopsAForwardStep) {
  ros::Publisher bumper = nh_.advertise<std_msgs::Bool>("bumper", 1, true);
  ASSERT_TRUE(tick_until([&] { return bumper.getNumSubscribers() > 0; }));
  be_heard();
  start(action(1, DiscreteAction::MOVE_FORWARD, 5.0));
  std_msgs::Bool pressed;
  pressed.data = 1;
  bumper.publish(pressed);
  ASSERT_TRUE(tick_until([this] { return has_result(1); }, 3.0)) << node_.output();
  EXPECT_EQ(results_.back().outcome, MotionResult::BLOCKED);
}

/// What a driver of a Kobuki publishes: uint8 bumper (0 left, 1 center, 2 right), uint8 state.
topic_tools::ShapeShifter kobuki_bumper_event(std::uint8_t bumper, std::uint8_t state) {
  std::array<std::uint8_t, 2> bytes{bumper, state};
  ros::serialization::IStream stream{bytes.data(), static_cast<std::uint32_t>(bytes.size())};
  topic_tools::ShapeShifter message;
  message.morph("ffe360cd50f14f9251d9844083e72ac5", "kobuki_msgs/BumperEvent",
                "uint8 bumper\nuint8 state\n", "0");
  message.read(stream);
  return message;
}

TEST_F(MotionControllerTest, AKobukiStandsUntilAllItsBumpersAreFree) {
  ros::Publisher bumper = kobuki_bumper_event(0, 0).advertise(nh_, "bumper", 10);
  ASSERT_TRUE(tick_until([&] { return bumper.getNumSubscribers() > 0; }));
  be_heard();
  start(action(1, DiscreteAction::MOVE_FORWARD, 5.0));
  bumper.publish(kobuki_bumper_event(1, 1));
  bumper.publish(kobuki_bumper_event(2, 1));
  bumper.publish(kobuki_bumper_event(2, 0));
  ASSERT_TRUE(tick_until([this] { return has_result(1); }, 3.0)) << node_.output();
  EXPECT_EQ(results_.back().outcome, MotionResult::BLOCKED);
  actions_.publish(action(2, DiscreteAction::MOVE_FORWARD));
  ASSERT_TRUE(tick_until([this] { return has_result(2); }));
  EXPECT_EQ(results_.back().outcome, MotionResult::BLOCKED) << "the center is still pressed";
  bumper.publish(kobuki_bumper_event(1, 0));
  for (std::uint32_t id = 3; results_.back().outcome != MotionResult::SUCCEEDED; ++id) {
    ASSERT_LT(id, 50U) << "it stands for ever";
    actions_.publish(action(id, DiscreteAction::MOVE_FORWARD));
    ASSERT_TRUE(tick_until([&] { return has_result(id); }));
  }
}

TEST_F(MotionControllerTest, WhatIsNoActionIsDroppedAndCounted) {
  be_heard();
  ASSERT_TRUE(tick_until([this] {
    actions_.publish(action(7, 200));
    actions_.publish(action(8, DiscreteAction::MOVE_FORWARD, -1.0));
    actions_.publish(
        action(9, DiscreteAction::MOVE_FORWARD, std::numeric_limits<double>::quiet_NaN()));
    return drops("action") >= 3.0;
  })) << node_.output();
  EXPECT_TRUE(results_.empty());
  EXPECT_FALSE(is_moving());
  start(action(10, DiscreteAction::TURN_LEFT));
}

TEST_F(MotionControllerTest, AnActionBeforeAnyOdometryIsDroppedAndTakenWhenSentAgain) {
  is_odometry_awake_ = false;
  ASSERT_TRUE(tick_until([this] {
    actions_.publish(action(1, DiscreteAction::TURN_LEFT));
    return drops("action") > 0.0;
  })) << node_.output();
  is_odometry_awake_ = true;
  be_heard();
  start(action(1, DiscreteAction::TURN_LEFT));
  EXPECT_TRUE(tick_until([this] { return has_result(1); }));
}

TEST_F(MotionControllerTest, AnActionAskedForAgainIsAnsweredFromMemoryAndNotDoneTwice) {
  be_heard();
  start(action(4, DiscreteAction::MOVE_FORWARD));
  actions_.publish(action(4, DiscreteAction::MOVE_FORWARD));  // under way: goes on
  ASSERT_TRUE(tick_until([this] { return has_result(4); })) << node_.output();
  const MotionResult first = results_.back();
  const Pose2 there = pose_;
  results_.clear();
  actions_.publish(action(4, DiscreteAction::MOVE_FORWARD));
  ASSERT_TRUE(tick_until([this] { return has_result(4); })) << node_.output();
  EXPECT_EQ(results_.back().header.stamp, first.header.stamp);
  EXPECT_EQ(results_.back().displacement.x, first.displacement.x);
  EXPECT_NEAR(pose_.x, there.x, 1e-3);
}

TEST_F(MotionControllerTest, ANewActionPreemptsTheOneUnderWayAndStopEndsIt) {
  be_heard();
  start(action(1, DiscreteAction::MOVE_FORWARD, 5.0));
  actions_.publish(action(2, DiscreteAction::TURN_LEFT));
  ASSERT_TRUE(tick_until([this] { return has_result(2); })) << node_.output();
  ASSERT_EQ(results_.size(), 2U);
  EXPECT_EQ(results_.all()[0]->id, 1U);
  EXPECT_EQ(results_.all()[0]->outcome, MotionResult::PREEMPTED);
  EXPECT_EQ(results_.back().outcome, MotionResult::SUCCEEDED);

  start(action(3, DiscreteAction::MOVE_FORWARD, 5.0));
  actions_.publish(action(0, DiscreteAction::STOP));
  ASSERT_TRUE(tick_until([this] { return has_result(3); })) << node_.output();
  EXPECT_EQ(results_.back().outcome, MotionResult::PREEMPTED);
  EXPECT_FALSE(is_moving());
}

}  // namespace
}  // namespace cmn
