// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The whole graph of simulation.launch on its way. Each journey_*.test runs one of these tests.
#include "coarse_map_nav/Belief.h"
#include "coarse_map_nav/DiscreteAction.h"
#include "coarse_map_nav/LocalOccupancy.h"
#include "coarse_map_nav/MotionResult.h"
#include "coarse_map_nav/NavigationStatus.h"
#include "coarse_map_nav/mapping/places.hpp"
#include "coarse_map_nav/navigator.hpp"
#include "coarse_map_nav/ros/conversions.hpp"
#include "coarse_map_nav/ros/node.hpp"
#include "coarse_map_nav/ros/node_params.hpp"
#include "coarse_map_nav/ros/tf_lookup.hpp"

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
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <ros/network.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

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
    // A panorama, and with it the first belief, begins with the journey: before, nobody turns.
    const bool is_panorama =
        ros::param::param<std::string>("/perception/perception/accumulate", "") == "panorama";
    ASSERT_TRUE(wait_for([&] {
      return client_.isServerConnected() && (is_panorama || !beliefs_.empty()) &&
             !truths_.empty() && !odoms_.empty() && initial_poses_.getNumSubscribers() > 0;
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
    goal_message_ = message;
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
  move_base_msgs::MoveBaseGoal goal_message_;
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

/// What was heard of a journey, for doing it again without ROS.
class ReplayedJourney : public Journey {
 protected:
  /// The localizer begins anew, before the eyes of this test and of the planner, which would
  /// otherwise decide on the last belief of the one before.
  void restart_localizer() {
    const auto heard_by_planner = [this] {
      return diagnosed(diagnostics_, "planner: belief", "received");
    };
    ASSERT_TRUE(wait_for(
        [&] { return !observations_.empty() && !maps_.empty() && heard_by_planner() >= 1.0; }));
    const double before = heard_by_planner();
    const pid_t first = pid_of("/localizer");
    ASSERT_GT(first, 0);
    kill(first, SIGKILL);
    beliefs_.clear();  // at rest none is under way
    ASSERT_TRUE(wait_for([&] { return !beliefs_.empty() && heard_by_planner() > before; }));
  }
  using Look = coarse_map_nav::LocalOccupancy;
  static const Look* look_at(const Inbox<Look>& looks, const ros::Time& stamp) {
    for (const auto& look : looks.all()) {
      if (look->header.stamp == stamp) {
        return look.get();
      }
    }
    return nullptr;
  }
  const coarse_map_nav::DiscreteAction* action_of(std::uint32_t id) const {
    for (const auto& action : actions_.all()) {
      if (action->id == id) {
        return action.get();
      }
    }
    return nullptr;
  }
  MotionOutcome outcome_of(std::uint32_t id) const {
    for (const auto& result : results_.all()) {
      if (result->id == id) {
        return static_cast<MotionOutcome>(result->outcome);
      }
    }
    return MotionOutcome::kSucceeded;  // before the first action
  }
  /// As the nodes have loaded them.
  static NavigatorParams params() {
    NavigatorParams params =
        load_params_or_exit<NodeParams<PlannerNodeParams>>(ros::NodeHandle("/planner")).navigator;
    params.localization =
        load_params_or_exit<NodeParams<LocalizerNodeParams>>(ros::NodeHandle("/localizer"))
            .navigator.localization;
    return params;
  }

  tf2_ros::Buffer transforms_{ros::Duration(3600.0)};
  tf2_ros::TransformListener listener_{transforms_};
  Inbox<Look> observations_{"local_occupancy"};
  Inbox<Look> local_maps_{"local_map"};
  Inbox<coarse_map_nav::DiscreteAction> actions_{"action"};
  Inbox<nav_msgs::OccupancyGrid> maps_{"map"};
  Inbox<diagnostic_msgs::DiagnosticArray> diagnostics_{"/diagnostics"};
};

TEST_F(ReplayedJourney, InProcessTheNavigatorBelievesAndDecidesTheSame) {
  ASSERT_NO_FATAL_FAILURE(restart_localizer());
  ASSERT_NO_FATAL_FAILURE(send_goal(""));
  const auto enough = static_cast<std::size_t>(ros::param::param("~actions", 40));
  const std::size_t before = actions();
  ASSERT_TRUE(
      wait_for([&] { return has_ended() || actions() >= before + enough; }, kJourneyPatience_s));

  std::string why;
  const auto map = map_of(maps_.back(), why);
  ASSERT_TRUE(map) << why;
  Navigator navigator{*map, params()};
  const Point2 goal{goal_message_.target_pose.pose.position.x,
                    goal_message_.target_pose.pose.position.y};
  ASSERT_FALSE(navigator.planner().set_goal(goal));
  int compared = 0;
  for (std::size_t i = 0; i + 1 < beliefs_.size(); ++i) {
    const auto& belief = *beliefs_.all()[i];
    if (i > 0 && belief.header.stamp == beliefs_.all()[i - 1]->header.stamp) {
      continue;  // sent again, because the planner asked
    }
    SCOPED_TRACE("belief " + std::to_string(i) + " after action " +
                 std::to_string(belief.action_id));
    const Look* observation = look_at(observations_, belief.header.stamp);
    ASSERT_NE(observation, nullptr);
    const auto seen = local_occupancy_of(*observation, why);
    ASSERT_TRUE(seen) << why;
    // The planner may have been late for the first, and have taken the next: nothing had moved.
    const Look* const wide = look_at(local_maps_, belief.header.stamp);
    ASSERT_NE(wide, nullptr);
    const auto local_map = local_occupancy_of(*wide, why);
    ASSERT_TRUE(local_map) << why;
    const auto T_odom_robot =
        lookup(transforms_, "odom", observation->header.frame_id, observation->header.stamp, why);
    ASSERT_TRUE(T_odom_robot) << why;
    const Decision decision = navigator.step(
        Percept{*seen, *local_map, static_cast<double>(observation->clear_ahead), true, {}},
        *T_odom_robot, outcome_of(belief.action_id));

    const Localization at = navigator.localizer().localization();
    const auto theirs = belief_of(belief, *map, why);
    ASSERT_TRUE(theirs) << why;
    for (const Heading h : kHeadings) {
      for (std::size_t c = 0; c < map->occupied().size(); ++c) {
        const Cell cell = map->occupied().cell_at(c);
        ASSERT_NEAR(at.belief(h, cell), theirs->belief(h, cell), 1e-6);
      }
    }
    EXPECT_EQ(at.estimate, theirs->estimate);
    const auto* action = action_of(belief.action_id + 1);
    ASSERT_NE(action, nullptr);
    EXPECT_EQ(static_cast<int>(decision.action.type), static_cast<int>(action->type));
    EXPECT_FLOAT_EQ(static_cast<float>(decision.action.distance_m), action->distance);
    EXPECT_NEAR(decision.action.axes_yaw_rad, static_cast<double>(action->axes_yaw), 1e-6);
    ++compared;
  }
  EXPECT_GE(compared, has_ended() ? 1 : static_cast<int>(enough) - 2);
}

}  // namespace
}  // namespace cmn
