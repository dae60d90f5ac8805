// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The whole graph of simulation.launch on its way. Each journey_*.test runs one of these tests.
#include "coarse_map_nav/Belief.h"
#include "coarse_map_nav/MotionResult.h"
#include "coarse_map_nav/NavigationStatus.h"
#include "coarse_map_nav/mapping/places.hpp"
#include "coarse_map_nav/ros/conversions.hpp"

#include <cmath>
#include <csignal>
#include <map>
#include <numeric>
#include <optional>
#include <string>

#include "ros_graph.hpp"
#include <XmlRpc.h>
#include <actionlib/client/simple_action_client.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/Odometry.h>
#include <ros/network.h>

namespace cmn {
namespace {

using coarse_map_nav::NavigationStatus;
using Client = actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction>;
using ClientState = actionlib::SimpleClientGoalState;

constexpr double kJourneyPatience_s = 120.0;

/// Watches a journey and what must hold all along it.
class Journey : public testing::Test {
 protected:
  void SetUp() override {
    places_ = read_places(ros::param::param<std::string>("/coarse_map_server/map", ""));
    ASSERT_TRUE(wait_for([this] {
      return client_.isServerConnected() && !beliefs_.empty() && !truths_.empty() &&
             !odoms_.empty() && initial_poses_.getNumSubscribers() > 0;
    }));
    start_ = truths_.back();
    T_odom_start_ = *pose_of(odoms_.back().pose.pose);
  }

  void send_goal(const std::string& place) {
    const Place* goal = places_.find(place.empty() ? places_.default_goal : place);
    ASSERT_NE(goal, nullptr);
    move_base_msgs::MoveBaseGoal message;
    message.target_pose.header.frame_id = "map";
    message.target_pose.pose = pose_message({goal->map.x, goal->map.y, 0.0});
    client_.sendGoal(message);
    goal_ = goal->world;
  }

  /// Gives the localizer the pose, as 2D Pose Estimate does: the place where it began, and on from
  /// there as it truly moved, which is the drawing's measure too over a short way.
  void tell_where_it_is() {
    const std::string start = ros::param::param<std::string>("~start", "unknown");
    const Place* place = places_.find(start);
    ASSERT_NE(place, nullptr) << start;
    const Pose2 T_world_start = *pose_of(start_.pose.pose);
    const Pose2 T_start_now = inverse(T_world_start) * *pose_of(truths_.back().pose.pose);
    geometry_msgs::PoseWithCovarianceStamped pose;
    pose.header.frame_id = "map";
    pose.pose.pose =
        pose_message(Pose2{place->map.x, place->map.y, T_world_start.yaw} * T_start_now);
    pose.pose.covariance[0] = pose.pose.covariance[7] = 0.2 * 0.2;
    pose.pose.covariance[35] = 0.1 * 0.1;
    ASSERT_TRUE(wait_for([this] { return initial_poses_.getNumSubscribers() > 0; }));
    const std::size_t before = beliefs_.size();
    initial_poses_.publish(pose);
    ASSERT_TRUE(
        wait_for([&] { return beliefs_.size() > before && beliefs_.back().confidence > 0.8F; }));
  }

  /// Actions that have ended since the beginning.
  std::size_t actions() const { return results_.size(); }
  bool has_ended() const {
    return !statuses_.empty() && (statuses_.back().state == NavigationStatus::REACHED ||
                                  statuses_.back().state == NavigationStatus::FAILED);
  }

  /// Beliefs are distributions, and the robot is where its odometry says, but for slip and drift.
  void expect_sane() const {
    for (const auto& belief : beliefs_.all()) {
      double total = 0.0;
      for (const float p : belief->probability) {
        ASSERT_GE(p, 0.0F);
        total += static_cast<double>(p);
      }
      ASSERT_NEAR(total, 1.0, 1e-3);
      ASSERT_TRUE(std::isfinite(belief->entropy) && belief->confidence <= 1.001F);
    }
    double driven_m = 0.0;
    for (std::size_t i = 1; i < odoms_.size(); ++i) {
      const auto& a = odoms_.all()[i - 1]->pose.pose.position;
      const auto& b = odoms_.all()[i]->pose.pose.position;
      driven_m += std::hypot(b.x - a.x, b.y - a.y);
    }
    const Pose2 by_odometry = inverse(T_odom_start_) * *pose_of(odoms_.back().pose.pose);
    const Pose2 truly = inverse(*pose_of(start_.pose.pose)) * *pose_of(truths_.back().pose.pose);
    EXPECT_LT(norm(by_odometry.position() - truly.position()), 0.3 + 0.15 * driven_m);
  }

  double to_goal_m() const { return norm(pose_of(truths_.back().pose.pose)->position() - goal_); }

  MapPlaces places_;
  Point2 goal_{};
  nav_msgs::Odometry start_;
  Pose2 T_odom_start_;
  ros::NodeHandle nh_;
  ros::Publisher initial_poses_ =
      nh_.advertise<geometry_msgs::PoseWithCovarianceStamped>("initialpose", 1);
  Inbox<coarse_map_nav::Belief> beliefs_{"belief"};
  Inbox<coarse_map_nav::MotionResult> results_{"motion_result"};
  Inbox<NavigationStatus> statuses_{"status"};
  Inbox<nav_msgs::Odometry> odoms_{"odom"};
  Inbox<nav_msgs::Odometry> truths_{"ground_truth"};
  Client client_{"move_base", true};
};

/// The process of a node, as its XML-RPC server says; 0 when it does not answer.
pid_t pid_of(const std::string& node) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue payload;
  request[0] = ros::this_node::getName();
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, payload, false)) {
    return 0;
  }
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(static_cast<std::string>(payload), host, port)) {
    return 0;
  }
  XmlRpc::XmlRpcClient client{host.c_str(), static_cast<int>(port), "/"};
  XmlRpc::XmlRpcValue caller;
  XmlRpc::XmlRpcValue answer;
  caller[0] = ros::this_node::getName();
  if (!client.execute("getPid", caller, answer) || client.isFault() || answer.size() != 3) {
    return 0;
  }
  return static_cast<int>(answer[2]);
}

TEST_F(Journey, FromAnUnknownStartGoesOnUntilItIsThereOrGivesUp) {
  ASSERT_NO_FATAL_FAILURE(send_goal(""));
  // How often it arrives is measured elsewhere; here it has to keep going.
  const auto enough = static_cast<std::size_t>(ros::param::param("~actions", 25));
  ASSERT_TRUE(wait_for([&] { return has_ended() || actions() >= enough; }, kJourneyPatience_s))
      << actions() << " actions";
  expect_sane();
  if (has_ended()) {
    ASSERT_TRUE(wait_for([this] { return client_.getState().isDone(); }));
    EXPECT_EQ(client_.getState() == ClientState::SUCCEEDED,
              statuses_.back().state == NavigationStatus::REACHED);
    EXPECT_FALSE(client_.getState().getText().empty()) << "it must say why";
  }
}

TEST_F(Journey, FromAKnownStartArrives) {
  ASSERT_NO_FATAL_FAILURE(tell_where_it_is());
  ASSERT_NO_FATAL_FAILURE(send_goal(ros::param::param<std::string>("~goal", "")));
  ASSERT_TRUE(wait_for([this] { return client_.getState().isDone(); }, kJourneyPatience_s))
      << actions() << " actions";
  EXPECT_EQ(client_.getState(), ClientState::SUCCEEDED) << client_.getState().getText();
  EXPECT_LT(to_goal_m(), 1.5) << "it says that it is there";
  expect_sane();
}

TEST_F(Journey, ArrivesAlthoughEveryNodeIsKilledOnTheWay) {
  ASSERT_NO_FATAL_FAILURE(tell_where_it_is());
  ASSERT_NO_FATAL_FAILURE(send_goal(ros::param::param<std::string>("~goal", "")));
  for (const std::string name :
       {"/localizer", "/perception", "/planner", "/motion_controller", "/coarse_map_server"}) {
    SCOPED_TRACE(name);
    const std::size_t before = actions();
    ASSERT_TRUE(wait_for([&] { return has_ended() || actions() >= before + 2; }))
        << "the journey stands still";
    ASSERT_FALSE(has_ended()) << "too short a journey, or: " << statuses_.back().text;
    const pid_t first = pid_of(name);
    ASSERT_GT(first, 0);
    const std::size_t beliefs = beliefs_.size();
    kill(first, SIGKILL);
    ASSERT_TRUE(wait_for([&] {
      const pid_t now = pid_of(name);
      return now > 0 && now != first;
    })) << "it does not come back";
    if (name == "/localizer") {  // it knows nothing; whether it would find itself is chance
      ASSERT_TRUE(wait_for([&] { return beliefs_.size() > beliefs; }));
      ASSERT_NO_FATAL_FAILURE(tell_where_it_is());
    }
  }
  ASSERT_TRUE(wait_for([this] { return has_ended(); }, kJourneyPatience_s))
      << actions() << " actions";
  EXPECT_EQ(statuses_.back().state, NavigationStatus::REACHED) << statuses_.back().text;
  EXPECT_LT(to_goal_m(), 1.5) << "it says that it is there";
  expect_sane();
}

}  // namespace
}  // namespace cmn
