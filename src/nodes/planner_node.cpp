// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// belief and goal -> one action at a time.

#include "coarse_map_nav/Belief.h"
#include "coarse_map_nav/localization/belief_filter.hpp"
#include "coarse_map_nav/planning/planner.hpp"
#include "coarse_map_nav/ros/action_orders.hpp"
#include "coarse_map_nav/ros/conversions.hpp"
#include "coarse_map_nav/ros/goal_server.hpp"
#include "coarse_map_nav/ros/look_memory.hpp"
#include "coarse_map_nav/ros/node.hpp"
#include "coarse_map_nav/ros/node_params.hpp"
#include "coarse_map_nav/ros/plan_publisher.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>

namespace {

using State = cmn::NavigationState;

class PlannerNode {
 public:
  PlannerNode()
      : params_{cmn::load_params_or_exit<cmn::NodeParams<cmn::PlannerNodeParams>>(
            ros::NodeHandle("~"))},
        beliefs_{"belief", 0.0},
        plan_{nh_, params_.frames.map},
        orders_{nh_,
                [this](cmn::MotionOutcome outcome) {
                  planner_ ? planner_->action_ended(outcome) : void();
                }},
        looks_{nh_, params_.navigator.planning.needs_local_map(),
               [this] { return missing_.empty() ? void() : decide(*belief_); },
               [this](const std_msgs::Header& header) { on_partial_look(header); }},
        goals_{nh_, params_.frames.map, [this](cmn::Point2 goal) { return begin(goal); },
               [this] { cancel(); }} {
    map_sub_ = nh_.subscribe("map", 1, &PlannerNode::on_map, this);
    belief_sub_ = nh_.subscribe("belief", 1, &PlannerNode::on_belief, this);
    diagnostics_.setHardwareID("none");
    diagnostics_.add("belief", &beliefs_, &cmn::InputMonitor::report);
    timer_ = nh_.createTimer(ros::Duration(0.5), &PlannerNode::on_timer, this);
    publish_status(cmn::resting(State::kWaitingForMap, "waiting for a map"));
  }

 private:
  void on_map(const nav_msgs::OccupancyGrid& grid) {
    std::string why;
    const std::optional<cmn::CoarseMap> map = cmn::map_of(grid, why);
    if (!map) {
      ROS_ERROR_STREAM("map: " << why);
    } else if (!map_ || !cmn::is_same_drawing(*map_, *map)) {
      map_ = *map;
      planner_.emplace(*map, params_.navigator.planning);
      expected_ = params_.navigator.planning.uses_expected_looks()
                      ? cmn::make_expected_looks(*map, params_.navigator.localization)
                      : nullptr;
      publish_status(cmn::resting(State::kStopped, "waiting for a goal"));
      goals_.resume();
    }
  }

  std::optional<std::string> begin(cmn::Point2 goal) {
    if (!planner_) {
      return "there is no map yet";
    }
    const std::optional<std::string> reason = planner_->set_goal(goal);
    if (!reason) {
      is_under_way_ = true;
      if (belief_ && belief_->action_id >= orders_.id()) {
        decide(*belief_);
      }
    }
    return reason;
  }

  void on_belief(const coarse_map_nav::Belief::ConstPtr& msg) {
    beliefs_.received(msg->header.stamp);
    belief_ = msg;
    if (is_under_way_ && msg->action_id >= orders_.id()) {
      decide(*msg);
    }
  }

  /// Perception wants to see the rest of what can be seen from here.
  void on_partial_look(const std_msgs::Header& header) {
    if (!is_under_way_ || !orders_.has_ended_before(header.stamp)) {
      return;
    }
    const cmn::Decision decision =
        planner_->look_round(belief_ ? static_cast<double>(belief_->axes_yaw) : 0.0);
    orders_.order(decision.action, belief_ ? belief_->action_id : 0, header);
    publish_status(decision);
  }

  void decide(const coarse_map_nav::Belief& msg) {
    std::string why;
    const auto received = cmn::belief_of(msg, *map_, why);
    if (!received) {
      beliefs_.dropped(why);
      return;
    }
    std::optional<cmn::LocalOccupancy> local_map;
    if (looks_.needs_local_map() && !(local_map = looks_.local_map(msg.header.stamp, missing_))) {
      return;  // decided when it comes
    }
    missing_.clear();
    const cmn::Decision decision =
        planner_->decide(received->localization(expected_.get()),
                         looks_.was_blocked(msg.header.stamp, params_.navigator.planning.step_m),
                         local_map ? &*local_map : nullptr);
    plan_.publish_plan(*planner_, received->estimate.cell, *map_, msg.header);
    if (decision.state == State::kReached || decision.state == State::kFailed) {
      end(decision);
      goals_.finish(decision.state == State::kReached, decision.text);
      return;
    }
    orders_.order(decision.action, msg.action_id, msg.header);
    publish_status(decision);
    goals_.publish_feedback(msg.header, msg.estimate);
  }

  /// Orders nothing before the robot knows what is around it.
  void ask_for_local_map() {
    const std::string text = "waiting for local_map: " + missing_;
    ROS_WARN_STREAM_THROTTLE(5.0, text);
    looks_.ask();
    publish_status(cmn::resting(State::kLocalizing, text));
  }

  void cancel() {
    if (planner_) {
      end(cmn::resting(State::kStopped, "the goal was cancelled or refused"));
    }
  }

  void end(const cmn::Decision& decision) {
    publish_status(decision);
    is_under_way_ = false;
    missing_.clear();
    planner_->cancel_goal();
    orders_.stop();
  }

  void on_timer(const ros::TimerEvent& /*event*/) {
    if (!missing_.empty()) {
      ask_for_local_map();
    } else if (is_under_way_ && orders_.id() != 0 &&
               std::abs((ros::Time::now() - orders_.sent()).toSec()) > params_.own.resend_after_s) {
      ROS_WARN_STREAM("no belief after action " << orders_.id() << " yet: sending it again");
      orders_.repeat();
    }
    diagnostics_.update();
  }

  void publish_status(const cmn::Decision& decision) {
    const double confidence = belief_ ? static_cast<double>(belief_->confidence) : 0.0;
    plan_.publish_status(decision, confidence, planner_ ? &*planner_ : nullptr);
  }

  ros::NodeHandle nh_;
  cmn::NodeParams<cmn::PlannerNodeParams> params_;
  cmn::InputMonitor beliefs_;
  std::optional<cmn::CoarseMap> map_;
  std::optional<cmn::Planner> planner_;
  std::unique_ptr<cmn::ExpectedLooks> expected_;
  coarse_map_nav::Belief::ConstPtr belief_;
  std::string missing_;  ///< why belief_ cannot be decided on yet; else empty
  bool is_under_way_ = false;
  cmn::PlanPublisher plan_;
  cmn::ActionOrders orders_;
  cmn::LookMemory looks_;
  cmn::GoalServer goals_;
  ros::Subscriber map_sub_;
  ros::Subscriber belief_sub_;
  diagnostic_updater::Updater diagnostics_;
  ros::Timer timer_;
};

}  // namespace

int main(int argc, char** argv) { return cmn::spin_node<PlannerNode>(argc, argv, "planner"); }
