// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// belief and goal -> one action at a time. Serves move_base's action and rviz's 2D Nav Goal.

#include "coarse_map_nav/Belief.h"
#include "coarse_map_nav/DiscreteAction.h"
#include "coarse_map_nav/LocalOccupancy.h"
#include "coarse_map_nav/MotionResult.h"
#include "coarse_map_nav/NavigationStatus.h"
#include "coarse_map_nav/perception/obstacle_guard.hpp"
#include "coarse_map_nav/planning/planner.hpp"
#include "coarse_map_nav/ros/conversions.hpp"
#include "coarse_map_nav/ros/node.hpp"
#include "coarse_map_nav/ros/node_params.hpp"

#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <actionlib/server/simple_action_server.h>
#include <geometry_msgs/PoseStamped.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>

namespace {

using State = cmn::NavigationState;

class PlannerNode {
 public:
  PlannerNode()
      : params_{cmn::load_params_or_exit<cmn::NodeParams<cmn::PlannerNodeParams>>(
            ros::NodeHandle("~"))},
        server_{nh_, "move_base", false},
        beliefs_{"belief", 0.0} {
    action_pub_ = nh_.advertise<coarse_map_nav::DiscreteAction>("action", 1);
    path_pub_ = nh_.advertise<nav_msgs::Path>("path", 1, true);
    status_pub_ = nh_.advertise<coarse_map_nav::NavigationStatus>("status", 5, true);
    goal_pub_ = nh_.advertise<geometry_msgs::PoseStamped>("goal", 1, true);
    map_sub_ = nh_.subscribe("map", 1, &PlannerNode::on_map, this);
    occupancy_sub_ = nh_.subscribe("local_occupancy", 5, &PlannerNode::on_occupancy, this);
    result_sub_ = nh_.subscribe("motion_result", 5, &PlannerNode::on_result, this);
    belief_sub_ = nh_.subscribe("belief", 1, &PlannerNode::on_belief, this);
    simple_goal_sub_ =
        nh_.subscribe("move_base_simple/goal", 1, &PlannerNode::on_simple_goal, this);
    server_.registerGoalCallback([this] { on_action_goal(); });
    server_.registerPreemptCallback([this] { on_preempt(); });
    server_.start();
    diagnostics_.setHardwareID("none");
    diagnostics_.add("belief", &beliefs_, &cmn::InputMonitor::report);
    timer_ = nh_.createTimer(ros::Duration(0.5), &PlannerNode::on_timer, this);
    publish_status({State::kWaitingForMap, {}, kNoDistance, "waiting for a map"}, 0.0);
  }

 private:
  static constexpr double kNoDistance = std::numeric_limits<double>::quiet_NaN();

  void on_map(const nav_msgs::OccupancyGrid& grid) {
    std::string why;
    const std::optional<cmn::CoarseMap> map = cmn::map_of(grid, why);
    if (!map) {
      ROS_ERROR_STREAM("map: " << why);
      return;
    }
    if (map_ && map_->occupied() == map->occupied() && map_->resolution() == map->resolution()) {
      return;
    }
    map_ = *map;
    planner_.emplace(*map, params_.navigator.planning);
    publish_status({State::kStopped, {}, kNoDistance, "waiting for a goal"}, 0.0);
    std::vector<double> goal;
    if (ros::NodeHandle("~").getParam(kResume, goal) && goal.size() == 2) {
      ROS_INFO("going on to the goal that was under way");
      begin({goal[0], goal[1]});
    }
  }

  void on_simple_goal(const geometry_msgs::PoseStamped& goal) {
    if (server_.isActive()) {
      server_.setPreempted(move_base_msgs::MoveBaseResult(), "a 2D Nav Goal took over");
    }
    const std::string reason = try_goal(goal);
    ROS_ERROR_STREAM_COND(!reason.empty(), "goal rejected: " << reason);
  }

  void on_action_goal() {
    const auto goal = server_.acceptNewGoal();
    const std::string reason = try_goal(goal->target_pose);
    if (!reason.empty()) {
      ROS_ERROR_STREAM("goal rejected: " << reason);
      server_.setAborted(move_base_msgs::MoveBaseResult(), reason);
    }
  }

  void on_preempt() {
    server_.setPreempted();
    end({State::kStopped, {}, kNoDistance, "the goal was cancelled"});
  }

  /// The reason why the goal is rejected, empty when the robot is on its way.
  std::string try_goal(const geometry_msgs::PoseStamped& goal) {
    const std::string& frame = goal.header.frame_id;
    if (!map_) {
      return "there is no map yet";
    }
    if (frame != params_.frames.map) {
      return "it is given in frame \"" + frame + "\", goals are marked on the drawing, in \"" +
             params_.frames.map + "\"";
    }
    return begin({goal.pose.position.x, goal.pose.position.y}).value_or("");
  }

  std::optional<std::string> begin(cmn::Point2 goal) {
    const std::optional<std::string> reason = planner_->set_goal(goal);
    if (reason) {
      end({State::kFailed, {}, kNoDistance, *reason});
      return reason;
    }
    ros::NodeHandle("~").setParam(kResume, std::vector<double>{goal.x, goal.y});
    geometry_msgs::PoseStamped marked;
    marked.header.frame_id = params_.frames.map;
    marked.header.stamp = ros::Time::now();
    marked.pose = cmn::pose_message({goal.x, goal.y, 0.0});
    goal_pub_.publish(marked);
    is_under_way_ = true;
    if (belief_ && belief_->action_id >= action_.id) {
      decide(*belief_);
    }
    return std::nullopt;
  }

  void on_occupancy(const coarse_map_nav::LocalOccupancy::ConstPtr& msg) {
    recent_.push_back(msg);
    if (recent_.size() > 30) {
      recent_.pop_front();
    }
  }

  void on_result(const coarse_map_nav::MotionResult& result) {
    if (planner_ && result.id == action_.id) {
      planner_->action_ended(static_cast<cmn::MotionOutcome>(result.outcome));
    }
  }

  void on_belief(const coarse_map_nav::Belief::ConstPtr& msg) {
    beliefs_.received(msg->header.stamp);
    belief_ = msg;
    if (is_under_way_ && msg->action_id >= action_.id) {
      decide(*msg);
    }
  }

  void decide(const coarse_map_nav::Belief& msg) {
    std::string why;
    const auto received = cmn::belief_of(msg, *map_, why);
    if (!received) {
      beliefs_.dropped(why);
      return;
    }
    const cmn::Decision decision =
        planner_->decide({received->belief, received->estimate, static_cast<double>(msg.confidence),
                          msg.converged != 0},
                         is_blocked_at(msg.header.stamp));
    publish_path(received->estimate.cell, msg.header.stamp);
    action_.header = msg.header;
    action_.id = msg.action_id + 1;
    action_.type = static_cast<std::uint8_t>(decision.action.type);
    action_.distance = static_cast<float>(decision.action.distance_m);
    if (decision.state == State::kReached || decision.state == State::kFailed) {
      finish(decision);
      return;
    }
    send();
    publish_status(decision, static_cast<double>(msg.confidence));
    if (server_.isActive()) {
      move_base_msgs::MoveBaseFeedback feedback;
      feedback.base_position.header = msg.header;
      feedback.base_position.pose = msg.estimate;
      server_.publishFeedback(feedback);
    }
  }

  void finish(const cmn::Decision& decision) {
    if (server_.isActive()) {
      if (decision.state == State::kReached) {
        server_.setSucceeded(move_base_msgs::MoveBaseResult(), decision.text);
      } else {
        server_.setAborted(move_base_msgs::MoveBaseResult(), decision.text);
      }
    }
    end(decision);
  }

  void end(const cmn::Decision& decision) {
    publish_status(decision, belief_ ? static_cast<double>(belief_->confidence) : 0.0);
    is_under_way_ = false;
    ros::NodeHandle("~").deleteParam(kResume);
    if (planner_) {
      planner_->cancel_goal();
    }
    action_.type = coarse_map_nav::DiscreteAction::STOP;
    action_.id = 0;
    action_pub_.publish(action_);
  }

  /// What the guard says of the observation that the belief was made from.
  bool is_blocked_at(const ros::Time& stamp) const {
    for (const auto& msg : recent_) {
      std::string why;
      if (msg->header.stamp == stamp) {
        const auto seen = cmn::local_occupancy_of(*msg, why);
        return !seen || cmn::is_blocked_ahead(*seen, params_.navigator.perception.guard);
      }
    }
    return true;  // not seen, not safe
  }

  void send() {
    action_pub_.publish(action_);
    sent_ = ros::Time::now();
  }

  void on_timer(const ros::TimerEvent& /*event*/) {
    if (is_under_way_ && action_.id != 0 &&
        (ros::Time::now() - sent_).toSec() > params_.own.resend_after_s) {
      ROS_WARN_STREAM("no belief after action " << action_.id << " yet: sending it again");
      send();
    }
    diagnostics_.update();
  }

  void publish_path(cmn::Cell from, const ros::Time& stamp) {
    nav_msgs::Path path;
    path.header.frame_id = params_.frames.map;
    path.header.stamp = stamp;
    for (const cmn::Cell c : planner_->path_from(from)) {
      const cmn::Point2 p = map_->center_of(c);
      geometry_msgs::PoseStamped pose;
      pose.header = path.header;
      pose.pose = cmn::pose_message({p.x, p.y, 0.0});
      path.poses.push_back(pose);
    }
    path_pub_.publish(path);
  }

  void publish_status(const cmn::Decision& decision, double confidence) {
    coarse_map_nav::NavigationStatus status;
    status.header.stamp = ros::Time::now();
    status.header.frame_id = params_.frames.map;
    status.state = static_cast<std::uint8_t>(decision.state);
    status.text = decision.text;
    status.confidence = static_cast<float>(confidence);
    status.distance_to_go = static_cast<float>(decision.distance_to_go_m);
    status.actions = planner_ ? static_cast<std::uint32_t>(planner_->actions()) : 0U;
    status_pub_.publish(status);
  }

  /// Where the goal under way is kept, so that a planner that was restarted goes on.
  static constexpr const char* kResume = "goal_under_way";

  ros::NodeHandle nh_;
  cmn::NodeParams<cmn::PlannerNodeParams> params_;
  actionlib::SimpleActionServer<move_base_msgs::MoveBaseAction> server_;
  cmn::InputMonitor beliefs_;
  std::optional<cmn::CoarseMap> map_;
  std::optional<cmn::Planner> planner_;
  coarse_map_nav::Belief::ConstPtr belief_;
  std::deque<coarse_map_nav::LocalOccupancy::ConstPtr> recent_;
  coarse_map_nav::DiscreteAction action_;
  bool is_under_way_ = false;
  ros::Time sent_;
  ros::Publisher action_pub_;
  ros::Publisher path_pub_;
  ros::Publisher status_pub_;
  ros::Publisher goal_pub_;
  ros::Subscriber map_sub_;
  ros::Subscriber occupancy_sub_;
  ros::Subscriber result_sub_;
  ros::Subscriber belief_sub_;
  ros::Subscriber simple_goal_sub_;
  diagnostic_updater::Updater diagnostics_;
  ros::Timer timer_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "planner");
  PlannerNode node;
  ros::spin();
  return 0;
}
