// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The whole graph in a real building, on a coarse grid that is made of it for the test.
#include "coarse_map_nav/NavigationStatus.h"
#include "coarse_map_nav/ros/conversions.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "file_fixture.hpp"
#include "ros_graph.hpp"
#include <actionlib/client/simple_action_client.h>
#include <gtest/gtest.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/Odometry.h>

namespace cmn {
namespace {

using Client = actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction>;
using ClientState = actionlib::SimpleClientGoalState;

constexpr double kJourneyPatience_s = 130.0;

/// Where from and where to in a building, both also on its grid, which has no other frame.
struct Errand {
  std::string building;
  Pose2 T_world_start;
  Point2 goal;
};
std::ostream& operator<<(std::ostream& out, const Errand& errand) { return out << errand.building; }

class Building : public testing::TestWithParam<Errand> {
 protected:
  void launch(const std::string& world) {
    map_ = testing::TempDir() + "building_" + GetParam().building + ".yaml";
    NodeProcess coarsen{"cmn_coarsen", {"--world", world, "--mpp", "0.4", "--out", map_}};
    ASSERT_TRUE(wait_for([&] { return coarsen.exit_status().has_value(); }));
    ASSERT_EQ(coarsen.exit_status(), 0) << coarsen.output();
    const Pose2& start = GetParam().T_world_start;
    ros::param::set("/simulator/start_x", start.x);
    ros::param::set("/simulator/start_y", start.y);
    ros::param::set("/simulator/start_yaw_deg", start.yaw * 180.0 / kPi);
    graph_ = std::make_unique<NodeProcess>(
        "/usr/bin/env", std::vector<std::string>{"roslaunch", "coarse_map_nav", "simulation.launch",
                                                 "world_file:=" + world, "map:=" + map_, "seed:=1",
                                                 "speed:=10", "respawn:=false"});
  }

  std::string map_;
  std::unique_ptr<NodeProcess> graph_;
};

TEST_P(Building, FromAnUnknownStartAndHeadingArrives) {
  const std::string world = data_file("worlds/" + GetParam().building + ".yaml");
  CMN_NEEDS_DATA(world);
  ASSERT_NO_FATAL_FAILURE(launch(world));
  Inbox<nav_msgs::Odometry> truths{"ground_truth"};
  Inbox<coarse_map_nav::NavigationStatus> statuses{"status"};
  Client client{"move_base", true};
  ASSERT_TRUE(wait_for([&] {
    return client.isServerConnected() && !truths.empty() && !statuses.empty() &&
           statuses.back().state == coarse_map_nav::NavigationStatus::STOPPED;  // it has its map
  })) << graph_->output();
  move_base_msgs::MoveBaseGoal goal;
  goal.target_pose.header.frame_id = "map";
  goal.target_pose.pose = pose_message({GetParam().goal.x, GetParam().goal.y, 0.0});
  client.sendGoal(goal);
  ASSERT_TRUE(wait_for([&] { return client.getState().isDone(); }, kJourneyPatience_s))
      << (statuses.empty() ? graph_->output() : statuses.back().text);
  EXPECT_EQ(client.getState(), ClientState::SUCCEEDED) << client.getState().getText();
  const Point2 there = pose_of(truths.back().pose.pose)->position();
  EXPECT_LT(norm(there - GetParam().goal), 1.0) << "it says that it is there";
}

INSTANTIATE_TEST_SUITE_P(
    Real, Building,
    testing::Values(Errand{"intel", {2.15, 3.45, 0.0}, {11.05, 1.35}},
                    Errand{"freiburg-079", {10.85, 5.45, -kPi / 2.0}, {6.95, 11.45}}));

}  // namespace
}  // namespace cmn
