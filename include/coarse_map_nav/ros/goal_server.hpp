// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How goals reach the planner: move_base's action, rviz's 2D Nav Goal, and its own memory.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <functional>
#include <optional>
#include <string>

#include <actionlib/server/simple_action_server.h>
#include <geometry_msgs/PoseStamped.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <ros/ros.h>

namespace cmn {

/// Takes goals as move_base does: the action server `move_base` and the topic
/// `move_base_simple/goal`, the newest wins. Publishes the accepted one, latched, as `goal`.
///
/// The goal under way is kept on the parameter server, so that a planner that died and was started
/// again goes on to it.
class GoalServer {
 public:
  /// Begins the journey to a point of the map frame; the reason, when the goal is refused.
  using Begin = std::function<std::optional<std::string>(Point2 goal_map)>;
  using Cancel = std::function<void()>;

  GoalServer(ros::NodeHandle& nh, std::string map_frame, Begin begin, Cancel cancel);

  /// Goes on to the goal of an earlier life, if there was one. Call it when a map is there.
  void resume();
  /// The robot's whereabouts, for the action's client.
  void publish_feedback(const std_msgs::Header& header, const geometry_msgs::Pose& robot);
  /// The journey is over; the client, if there is one, is told.
  void finish(bool reached, const std::string& text);

 private:
  void on_simple_goal(const geometry_msgs::PoseStamped& goal);
  void on_action_goal();
  void on_preempt();
  std::optional<std::string> accept(const geometry_msgs::PoseStamped& goal);

  /// What was under way ends with a goal that is refused.
  void end_if(const std::optional<std::string>& refused);

  std::string map_frame_;
  std::string under_way_key_;  ///< beside the node: below it lie only parameters that it knows
  Begin begin_;
  Cancel cancel_;
  actionlib::SimpleActionServer<move_base_msgs::MoveBaseAction> server_;
  ros::Publisher goal_pub_;
  ros::Subscriber simple_goal_sub_;
};

}  // namespace cmn
