// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// action -> cmd_vel, and what was really driven. Steps once for every odometry message.

#include "coarse_map_nav/DiscreteAction.h"
#include "coarse_map_nav/MotionResult.h"
#include "coarse_map_nav/motion/motion_controller.hpp"
#include "coarse_map_nav/ros/bumper.hpp"
#include "coarse_map_nav/ros/conversions.hpp"
#include "coarse_map_nav/ros/node.hpp"
#include "coarse_map_nav/ros/node_params.hpp"

#include <cmath>
#include <optional>
#include <string>

#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_msgs/Float32.h>

namespace {

class MotionControllerNode {
 public:
  MotionControllerNode()
      : params_{cmn::load_params_or_exit<cmn::NodeParams<cmn::MotionNodeParams>>(
            ros::NodeHandle("~"))},
        controller_{params_.navigator.motion},
        odometry_{"odom", params_.navigator.motion.odometry_timeout_s},
        guard_{"clear_ahead", params_.own.obstacle_timeout_s},
        actions_{"action", 0.0} {
    cmd_pub_ = nh_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    result_pub_ = nh_.advertise<coarse_map_nav::MotionResult>("motion_result", 5);
    odom_sub_ = nh_.subscribe("odom", 10, &MotionControllerNode::on_odometry, this,
                              ros::TransportHints().tcpNoDelay());
    action_sub_ = nh_.subscribe("action", 5, &MotionControllerNode::on_action, this);
    clear_sub_ = nh_.subscribe("clear_ahead", 1, &MotionControllerNode::on_clear, this);
    diagnostics_.setHardwareID("base");
    for (cmn::InputMonitor* input : {&odometry_, &guard_, &actions_}) {
      diagnostics_.add(input->name(), input, &cmn::InputMonitor::report);
    }
    watchdog_ = nh_.createTimer(ros::Duration(0.05), &MotionControllerNode::on_watchdog, this);
    diagnostics_timer_ = nh_.createTimer(ros::Duration(1.0),
                                         [this](const ros::TimerEvent&) { diagnostics_.update(); });
  }
  ~MotionControllerNode() { cmd_pub_.publish(geometry_msgs::Twist{}); }

 private:
  void on_action(const coarse_map_nav::DiscreteAction& msg) {
    const cmn::Action action{static_cast<cmn::ActionType>(msg.type),
                             static_cast<double>(msg.distance), static_cast<double>(msg.axes_yaw)};
    if (!cmn::is_executable(action)) {
      actions_.dropped("no such action");
      return;
    }
    actions_.received(msg.header.stamp);
    if (last_result_ && last_result_->id == msg.id && msg.id != 0) {
      result_pub_.publish(*last_result_);  // asked for again: it was done, only the answer was lost
      return;
    }
    if (!controller_.is_idle() && msg.id == active_id_) {
      return;  // asked for again while under way
    }
    if (!last_sample_) {
      actions_.dropped("there is no odometry yet");
      return;
    }
    active_id_ = msg.id;
    publish(controller_.start(msg.id, action, *last_sample_));
  }

  void on_odometry(const nav_msgs::Odometry& odom) {
    const std::optional<cmn::Pose2> T_odom_robot = cmn::pose_of(odom.pose.pose);
    if (!T_odom_robot) {
      odometry_.dropped("the pose is not a pose");
      return;
    }
    odometry_.received(odom.header.stamp);
    last_sample_ = cmn::OdometrySample{odom.header.stamp.toSec(), *T_odom_robot};
    last_arrival_ = ros::Time::now();
    const bool was_idle = controller_.is_idle();
    // Also when it was last heard before time went back.
    const bool is_guard_silent =
        std::abs((last_arrival_ - clear_arrival_).toSec()) > params_.own.obstacle_timeout_s;
    const cmn::MotionStep step = controller_.step(
        *last_sample_, is_guard_silent ? 0.0 : clear_ahead_m_, bumper_.is_pressed());
    if (!was_idle) {
      command(step.command);
    }
    publish(step.result);
  }

  void on_clear(const std_msgs::Float32& clear) {
    clear_ahead_m_ = static_cast<double>(clear.data);
    clear_arrival_ = ros::Time::now();
    guard_.received(clear_arrival_);
  }

  /// Odometry may fall silent: then nobody else would stop the base.
  void on_watchdog(const ros::TimerEvent& /*event*/) {
    if (controller_.is_idle() || !last_sample_) {
      return;
    }
    const double silent_s = (ros::Time::now() - last_arrival_).toSec();
    const auto result = controller_.check_silence(last_sample_->stamp_s + silent_s);
    if (result) {
      command({});
      ROS_WARN_STREAM("odometry is silent for " << silent_s << " s: stopped");
    }
    publish(result);
  }

  void command(const cmn::VelocityCommand& velocity) {
    geometry_msgs::Twist twist;
    twist.linear.x = velocity.linear_mps;
    twist.angular.z = velocity.angular_radps;
    cmd_pub_.publish(twist);
  }

  void publish(const std::optional<cmn::MotionResult>& result) {
    if (!result) {
      return;
    }
    std_msgs::Header header;
    header.stamp = ros::Time(last_sample_->stamp_s);
    header.frame_id = params_.frames.odom;
    const coarse_map_nav::MotionResult msg = cmn::message_of(*result, header);
    result_pub_.publish(msg);
    last_result_ = msg;
  }

  ros::NodeHandle nh_;
  cmn::Bumper bumper_{nh_};
  cmn::NodeParams<cmn::MotionNodeParams> params_;
  cmn::MotionController controller_;
  cmn::InputMonitor odometry_;
  cmn::InputMonitor guard_;
  cmn::InputMonitor actions_;
  std::optional<cmn::OdometrySample> last_sample_;
  ros::Time last_arrival_;
  ros::Time clear_arrival_;
  double clear_ahead_m_ = 0.0;
  std::uint32_t active_id_ = 0;
  std::optional<coarse_map_nav::MotionResult> last_result_;
  ros::Publisher cmd_pub_;
  ros::Publisher result_pub_;
  ros::Subscriber odom_sub_;
  ros::Subscriber action_sub_;
  ros::Subscriber clear_sub_;
  diagnostic_updater::Updater diagnostics_;
  ros::Timer watchdog_;
  ros::Timer diagnostics_timer_;
};

}  // namespace

int main(int argc, char** argv) {
  return cmn::spin_node<MotionControllerNode>(argc, argv, "motion_controller");
}
