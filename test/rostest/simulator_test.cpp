// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/conversions.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "file_fixture.hpp"
#include "ros_graph.hpp"
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/LaserScan.h>

namespace cmn {
namespace {

const std::string kWorld = std::string("_world:=") + CMN_SOURCE_DIR "/worlds/home.yaml";
const std::string kBase = "_frames/base:=base_footprint";

TEST(Simulator, RefusesWorldsAndStartsThatCannotBe) {
  const std::string wall =
      file_with("wall.pgm", std::string("P5\n9 9\n255\n") + std::string(81, '\0'));
  const std::string solid = file_with("solid.yaml", "image: " + wall +
                                                        "\nresolution: 0.05\norigin: [0, 0, 0]\n"
                                                        "negate: 0\noccupied_thresh: 0.65\n"
                                                        "free_thresh: 0.196\n");
  struct Case {
    std::vector<std::string> arguments;
    std::string says;
  };
  const std::vector<Case> cases{
      {{}, "world: name the world"},
      {{"_world:=/nowhere/world.yaml"}, "/nowhere/world.yaml"},
      {{"_world:=" + solid}, solid},
      {{"_world:=house:x"}, "house:x: a house has a number"},
      {{kWorld, kBase, "_start_x:=0.01", "_start_y:=0.01"}, "obstacle"},
      {{kWorld, kBase, "_start_x:=-50.0", "_start_y:=2.0"}, "obstacle"},
      {{kWorld, "_laser_frame:=lidar", "_depth_frame:=eye"},
       "/robot_description: its root is base_footprint, not the robot's frame base_link; has no "
       "link "
       "lidar; has no link eye"},
      {{kWorld, kBase, "robot_description:=nowhere"}, "robot_description: there is no such"},
      {{kWorld, "_speed:=0.0", "_scan_rate:=0.0"}, "scan_rate: 0 is outside"},
      {{kWorld, "_speed:=0.0", "_simulation/depth/width:=0"},
       "simulation/depth/width: 0 is outside"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.says);
    NodeProcess node{"simulator", c.arguments};
    ASSERT_TRUE(wait_for([&] { return !node.is_running(); })) << "it runs: " << node.output();
    EXPECT_EQ(node.exit_status(), 1) << node.output();
    EXPECT_NE(node.output().find(c.says), std::string::npos) << node.output();
    EXPECT_EQ(node.output().find("terminate called"), std::string::npos) << node.output();
    ros::param::del("/simulator");
  }
}

/// A running simulator, one second of it in `1 / kSpeed` real ones.
class RunningSimulator : public testing::Test {
 protected:
  static constexpr double kSpeed = 5.0;

  void SetUp() override {
    ASSERT_TRUE(wait_for([this] {
      return commands_.getNumSubscribers() > 0 && !clocks_.empty() && !odoms_.empty() &&
             !truths_.empty() && !scans_.empty();
    })) << node_.output();
  }
  double now_s() const { return clocks_.back().clock.toSec(); }
  bool waits_until(double time_s) {
    return wait_for([&] { return now_s() >= time_s; });
  }
  void command(double linear_mps) {
    geometry_msgs::Twist twist;
    twist.linear.x = linear_mps;
    commands_.publish(twist);
  }
  double speed_mps() const { return odoms_.back().twist.twist.linear.x; }

  ros::NodeHandle nh_;
  ros::Publisher commands_ = nh_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  Inbox<rosgraph_msgs::Clock> clocks_{"/clock"};
  Inbox<nav_msgs::Odometry> odoms_{"odom"};
  Inbox<nav_msgs::Odometry> truths_{"ground_truth"};
  Inbox<sensor_msgs::LaserScan> scans_{"scan"};
  NodeProcess node_{"simulator",
                    {kWorld, kBase, "_speed:=" + std::to_string(kSpeed), "_seed:=3",
                     "_start_x:=4.6", "_start_y:=5.55", "_start_yaw_deg:=0"}};
};

TEST_F(RunningSimulator, ClockIsMonotoneAndNeverFasterThanAsked) {
  const double begin_s = now_s();
  const ros::WallTime begin = ros::WallTime::now();
  ASSERT_TRUE(waits_until(begin_s + 10.0));
  const double real_s = (ros::WallTime::now() - begin).toSec();
  // A busy machine may be slower than asked for, hence no bound on that side but the patience.
  EXPECT_GT(real_s, 10.0 / kSpeed * 0.7);
  for (std::size_t i = 1; i < clocks_.size(); ++i) {
    ASSERT_GT(clocks_.all()[i]->clock, clocks_.all()[i - 1]->clock);
  }
  EXPECT_GT(clocks_.all().front()->clock, ros::Time{0.5}) << "0 means no time yet to ROS";
}

TEST_F(RunningSimulator, ScansAndOdometryAreWhatTheNodesTake) {
  ASSERT_TRUE(waits_until(now_s() + 2.0));
  for (const auto& scan : scans_.all()) {
    EXPECT_EQ(fault_of(*scan), "");
    EXPECT_EQ(scan->header.frame_id, "laser");
  }
  for (const auto& odom : odoms_.all()) {
    ASSERT_TRUE(pose_of(odom->pose.pose));
    EXPECT_EQ(odom->header.frame_id, "odom");
    EXPECT_EQ(odom->child_frame_id, "base_footprint");
  }
  EXPECT_NEAR(truths_.back().pose.pose.position.x, 4.6, 1e-6) << "it starts where it was told to";
  EXPECT_NEAR(odoms_.back().pose.pose.position.x, 0.0, 1e-6) << "the odometry starts at zero";
}

TEST_F(RunningSimulator, TheBaseDrivesAndStopsWhenCommandsFallSilent) {
  ASSERT_TRUE(wait_for([this] {
    command(0.2);
    return speed_mps() > 0.15;
  })) << node_.output();
  // Commands of the loop above may still be on their way when this begins.
  const double silent_since_s = now_s();
  ASSERT_TRUE(wait_for([this] { return speed_mps() == 0.0; })) << "it drives on";
  EXPECT_LT(odoms_.back().header.stamp.toSec() - silent_since_s, 10.0);
  EXPECT_GT(truths_.back().pose.pose.position.x, 4.6);
}

TEST_F(RunningSimulator, CommandsThatAreNoNumbersAreIgnored) {
  geometry_msgs::Twist twist;
  twist.linear.x = std::numeric_limits<double>::quiet_NaN();
  twist.angular.z = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 5; ++i) {
    commands_.publish(twist);
    ASSERT_TRUE(waits_until(now_s() + 0.2));
  }
  for (const auto& truth : truths_.all()) {
    ASSERT_TRUE(pose_of(truth->pose.pose));
  }
  EXPECT_TRUE(wait_for([this] {
    command(0.2);
    return speed_mps() > 0.1;
  }));
}

}  // namespace
}  // namespace cmn
