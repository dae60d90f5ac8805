// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/goal_server.hpp"

#include "coarse_map_nav/ros/conversions.hpp"

#include <utility>
#include <vector>

namespace cmn {

GoalServer::GoalServer(ros::NodeHandle& nh, std::string map_frame, Begin begin, Cancel cancel)
    : map_frame_{std::move(map_frame)},
      under_way_key_{nh.resolveName("goal_under_way")},
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
  if (!ros::param::get(under_way_key_, goal) || goal.size() != 2) {
    return;
  }
  ROS_INFO_STREAM("going on to the goal that was under way, " << goal[0] << ", " << goal[1]);
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = map_frame_;
  pose.pose = pose_message({goal[0], goal[1], 0.0});
  end_if(accept(pose));
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
  ros::param::del(under_way_key_);
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
  end_if(accept(server_.acceptNewGoal()->target_pose));
}

void GoalServer::end_if(const std::optional<std::string>& refused) {
  if (refused) {
    ROS_ERROR_STREAM("goal refused: " << *refused);
    cancel_();
    finish(false, *refused);
  }
}

void GoalServer::on_preempt() {
  ros::param::del(under_way_key_);
  cancel_();
  server_.setPreempted();
}

std::optional<std::string> GoalServer::accept(const geometry_msgs::PoseStamped& goal) {
  if (goal.header.frame_id != map_frame_) {
    return "it is given in frame \"" + goal.header.frame_id +
           "\"; goals are marked on the drawing, in \"" + map_frame_ + "\"";
  }
  const Point2 point{goal.pose.position.x, goal.pose.position.y};
  // Kept before the robot moves, and before it may turn out to be there already.
  std::vector<double> before;
  const bool had_one = ros::param::get(under_way_key_, before);
  ros::param::set(under_way_key_, std::vector<double>{point.x, point.y});
  const std::optional<std::string> reason = begin_(point);
  if (!reason) {
    goal_pub_.publish(goal);
  } else if (had_one) {
    ros::param::set(under_way_key_, before);
  } else {
    ros::param::del(under_way_key_);
  }
  return reason;
}

}  // namespace cmn
