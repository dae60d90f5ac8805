// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/goal_server.hpp"

#include "coarse_map_nav/ros/conversions.hpp"

#include <utility>
#include <vector>

namespace cmn {
namespace {

/// Where the goal under way is kept, below the node's private namespace.
constexpr const char* kUnderWay = "goal_under_way";

}  // namespace

GoalServer::GoalServer(ros::NodeHandle& nh, std::string map_frame, Begin begin, Cancel cancel)
    : map_frame_{std::move(map_frame)},
      begin_{std::move(begin)},
      cancel_{std::move(cancel)},
      server_{nh, "move_base", false} {
  goal_pub_ = nh.advertise<geometry_msgs::PoseStamped>("goal", 1, true);
  simple_goal_sub_ = nh.subscribe("move_base_simple/goal", 1, &GoalServer::on_simple_goal, this);
  server_.registerGoalCallback([this] { on_action_goal(); });
  server_.registerPreemptCallback([this] { on_preempt(); });
  server_.start();
}

void GoalServer::resume() {
  std::vector<double> goal;
  if (!ros::NodeHandle("~").getParam(kUnderWay, goal) || goal.size() != 2) {
    return;
  }
  ROS_INFO_STREAM("going on to the goal that was under way, " << goal[0] << ", " << goal[1]);
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = map_frame_;
  pose.pose = pose_message({goal[0], goal[1], 0.0});
  on_simple_goal(pose);
}

void GoalServer::publish_feedback(const std_msgs::Header& header,
                                  const geometry_msgs::Pose& robot) {
  if (server_.isActive()) {
    move_base_msgs::MoveBaseFeedback feedback;
    feedback.base_position.header = header;
    feedback.base_position.pose = robot;
    server_.publishFeedback(feedback);
  }
}

void GoalServer::finish(bool reached, const std::string& text) {
  ros::NodeHandle("~").deleteParam(kUnderWay);
  if (!server_.isActive()) {
    return;
  }
  if (reached) {
    server_.setSucceeded(move_base_msgs::MoveBaseResult(), text);
  } else {
    server_.setAborted(move_base_msgs::MoveBaseResult(), text);
  }
}

void GoalServer::on_simple_goal(const geometry_msgs::PoseStamped& goal) {
  const std::optional<std::string> reason = accept(goal);
  if (reason) {
    ROS_ERROR_STREAM("goal refused: " << *reason);
  } else if (server_.isActive()) {
    server_.setPreempted(move_base_msgs::MoveBaseResult(), "a 2D Nav Goal took over");
  }
}

void GoalServer::on_action_goal() {
  // As with move_base, a refused goal ends the one before as well: its client has been preempted.
  const std::optional<std::string> reason = accept(server_.acceptNewGoal()->target_pose);
  if (reason) {
    ROS_ERROR_STREAM("goal refused: " << *reason);
    cancel_();
    finish(false, *reason);
  }
}

void GoalServer::on_preempt() {
  ros::NodeHandle("~").deleteParam(kUnderWay);
  cancel_();
  server_.setPreempted();
}

std::optional<std::string> GoalServer::accept(const geometry_msgs::PoseStamped& goal) {
  if (goal.header.frame_id != map_frame_) {
    return "it is given in frame \"" + goal.header.frame_id +
           "\"; goals are marked on the drawing, in \"" + map_frame_ + "\"";
  }
  const Point2 point{goal.pose.position.x, goal.pose.position.y};
  const std::optional<std::string> reason = begin_(point);
  if (!reason) {
    ros::NodeHandle("~").setParam(kUnderWay, std::vector<double>{point.x, point.y});
    goal_pub_.publish(goal);
  }
  return reason;
}

}  // namespace cmn
