// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// local occupancy and odometry -> belief.

#include "coarse_map_nav/LocalOccupancy.h"
#include "coarse_map_nav/MotionResult.h"
#include "coarse_map_nav/localization/localizer.hpp"
#include "coarse_map_nav/localization/update_gate.hpp"
#include "coarse_map_nav/ros/belief_publisher.hpp"
#include "coarse_map_nav/ros/conversions.hpp"
#include "coarse_map_nav/ros/map_odom_broadcaster.hpp"
#include "coarse_map_nav/ros/node.hpp"
#include "coarse_map_nav/ros/node_params.hpp"
#include "coarse_map_nav/ros/tf_lookup.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <message_filters/subscriber.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <std_msgs/Empty.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>
#include <tf2_ros/transform_listener.h>

namespace {

using Occupancy = coarse_map_nav::LocalOccupancy;

class LocalizerNode {
 public:
  LocalizerNode()
      : params_{cmn::load_params_or_exit<cmn::NodeParams<cmn::LocalizerNodeParams>>(
            ros::NodeHandle("~"))},
        gate_{params_.own.gate},
        publisher_{nh_, params_.frames.map},
        observations_{"local_occupancy", 2.0},
        tf_broadcaster_{params_.frames.map, params_.frames.odom, params_.own.transform_tolerance_s},
        occupancy_sub_{nh_, "local_occupancy", 5},
        tf_filter_{occupancy_sub_, tf_buffer_, params_.frames.odom, 5, nh_} {
    observe_pub_ = nh_.advertise<std_msgs::Empty>("observe", 1);
    map_sub_ = nh_.subscribe("map", 1, &LocalizerNode::on_map, this);
    result_sub_ = nh_.subscribe("motion_result", 5, &LocalizerNode::on_result, this);
    pose_sub_ = nh_.subscribe("initialpose", 1, &LocalizerNode::on_initial_pose, this);
    service_ = nh_.advertiseService("global_localization", &LocalizerNode::on_global, this);
    tf_filter_.registerCallback(&LocalizerNode::on_observation, this);
    tf_filter_.registerFailureCallback([this](const Occupancy::ConstPtr&, auto) {
      observations_.dropped("no transform to " + params_.frames.odom + " at its time");
    });
    diagnostics_.setHardwareID("none");
    diagnostics_.add("local_occupancy", &observations_, &cmn::InputMonitor::report);
    diagnostics_.add("belief", this, &LocalizerNode::report);
    timer_ = nh_.createTimer(ros::Duration(1.0), &LocalizerNode::on_timer, this);
  }

 private:
  void on_map(const nav_msgs::OccupancyGrid& grid) {
    std::string why;
    const std::optional<cmn::CoarseMap> map = cmn::map_of(grid, why);
    if (!map) {
      ROS_ERROR_STREAM("map: " << why);
      return;
    }
    if (filter_ && cmn::is_same_drawing(filter_->map(), *map)) {
      return;  // the map server came back with the same drawing
    }
    start_over(*map);
    publisher_.place_layers(*map);
  }

  void start_over(const cmn::CoarseMap& map) {
    filter_ = cmn::make_localizer(map, params_.navigator.localization);
    contradictions_ = 0;
    gate_.reset();
  }

  void on_result(const coarse_map_nav::MotionResult& result) {
    if (!gate_.action_ended(result.id, result.header.stamp.toSec())) {
      publisher_.repeat();  // the planner asks for the action again: it has not heard the belief
    }
  }

  void on_observation(const Occupancy::ConstPtr& msg) {
    std::string why;
    const std::optional<cmn::LocalOccupancy> seen = cmn::local_occupancy_of(*msg, why);
    if (!seen) {
      observations_.dropped(why);
      return;
    }
    const std::optional<cmn::Pose2> T_odom_robot =
        cmn::lookup(tf_buffer_, params_.frames.odom, msg->header.frame_id, msg->header.stamp, why);
    if (!T_odom_robot) {
      observations_.dropped(why);
      return;
    }
    observations_.received(msg->header.stamp);
    if (!filter_ || msg->partial != 0) {
      return;
    }
    if (gate_.time_jumped_back(seen->stamp_s)) {
      ROS_WARN("time went backwards: starting over");
      start_over(filter_->map());
    }
    if (gate_.is_due(seen->stamp_s, *T_odom_robot)) {
      const cmn::Correction outcome = filter_->update(*seen, *T_odom_robot);
      ROS_WARN_COND(outcome != cmn::Correction::kApplied, "what is seen contradicts the map%s",
                    outcome == cmn::Correction::kReopened ? ": the belief is re-opened" : "");
      contradictions_ += outcome != cmn::Correction::kApplied;
      tf_broadcaster_.set(cmn::pose_in_map(filter_->map(), filter_->localization()) *
                          cmn::inverse(*T_odom_robot));
      publisher_.publish(*filter_, gate_.action_id(), msg->header.stamp);
    }
    tf_broadcaster_.send(msg->header.stamp);
  }

  void on_initial_pose(const geometry_msgs::PoseWithCovarianceStamped& msg) {
    const auto pose = cmn::pose_of(msg.pose.pose);
    if (!filter_ || !pose || msg.header.frame_id != params_.frames.map) {
      ROS_ERROR_STREAM("initialpose: needs a map and a pose in frame " << params_.frames.map);
      return;
    }
    const auto& c = msg.pose.covariance;
    const double sigma_m = std::sqrt(std::max({0.0, c[0], c[7]}));
    if (!filter_->reset_near(*pose, sigma_m, std::sqrt(std::max(0.0, c[35])))) {
      ROS_ERROR("initialpose: there is no free cell near it");
      return;
    }
    gate_.reset();
  }

  bool on_global(std_srvs::Empty::Request& /*request*/, std_srvs::Empty::Response& /*response*/) {
    if (filter_) {
      filter_->reset();
      gate_.reset();
    }
    return true;
  }

  void on_timer(const ros::TimerEvent& /*event*/) {
    if (gate_.is_waiting()) {
      observe_pub_.publish(std_msgs::Empty{});
    }
    diagnostics_.update();
  }

  void report(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using Status = diagnostic_msgs::DiagnosticStatus;
    if (!filter_) {
      status.summary(Status::WARN, "waiting for a map");
      return;
    }
    const cmn::Localization at = filter_->localization();
    status.summary(Status::OK, at.is_converged ? "converged" : "localizing");
    status.add("confidence", at.confidence);
    status.add("scale", at.scale);
    status.add("axes yaw [deg]", at.axes_yaw_rad * 180.0 / cmn::kPi);
    status.add("contradictions", contradictions_);
  }

  ros::NodeHandle nh_;
  cmn::NodeParams<cmn::LocalizerNodeParams> params_;
  std::unique_ptr<cmn::Localizer> filter_;
  cmn::UpdateGate gate_;
  cmn::BeliefPublisher publisher_;
  cmn::InputMonitor observations_;
  std::uint64_t contradictions_ = 0;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_{tf_buffer_};
  cmn::MapOdomBroadcaster tf_broadcaster_;
  message_filters::Subscriber<Occupancy> occupancy_sub_;
  tf2_ros::MessageFilter<Occupancy> tf_filter_;
  ros::Publisher observe_pub_;
  ros::Subscriber map_sub_;
  ros::Subscriber result_sub_;
  ros::Subscriber pose_sub_;
  ros::ServiceServer service_;
  diagnostic_updater::Updater diagnostics_;
  ros::Timer timer_;
};

}  // namespace

int main(int argc, char** argv) { return cmn::spin_node<LocalizerNode>(argc, argv, "localizer"); }
