// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmd_vel -> scan, depth/image, points, image, odom, TF, /clock: a base with sensors in a world.
/// Where they are says robot_description, from which robot_state_publisher has the transforms that
/// do not change.

#include "coarse_map_nav/mapping/places.hpp"
#include "coarse_map_nav/ros/camera_publisher.hpp"
#include "coarse_map_nav/ros/conversions.hpp"
#include "coarse_map_nav/ros/described_mounts.hpp"
#include "coarse_map_nav/ros/node.hpp"
#include "coarse_map_nav/ros/node_params.hpp"
#include "coarse_map_nav/scene/scene_world.hpp"
#include "coarse_map_nav/scene/simulated_robot.hpp"

#include <cmath>
#include <exception>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Bool.h>
#include <tf2_ros/transform_broadcaster.h>

namespace {

using Params = cmn::NodeParams<cmn::SimulatorNodeParams>;

/// The start that the parameters give. What they leave open is drawn from the seed: a place out of
/// a map's list of starts or, without one, anywhere that the robot fits; one of four headings.
cmn::Pose2 start_of(const cmn::SimulatorNodeParams& own, const cmn::SceneWorld& world) {
  std::mt19937 rng{own.seed};
  std::optional<cmn::Pose2> start =
      cmn::World{world.body}.random_free_pose(own.simulation.robot.radius_m + 0.05, rng);
  if (!start) {
    throw std::runtime_error(own.world + ": the robot fits nowhere in this world");
  }
  const auto starts = world.is_map ? cmn::read_starts(own.world) : std::vector<cmn::Point2>{};
  if (!starts.empty()) {
    const cmn::Point2 place = starts[rng() % starts.size()];
    start = cmn::Pose2{place.x, place.y, start->yaw};
  }
  return {std::isnan(own.start_x) ? start->x : own.start_x,
          std::isnan(own.start_y) ? start->y : own.start_y,
          std::isnan(own.start_yaw_deg) ? start->yaw : own.start_yaw_deg * cmn::kPi / 180.0};
}

class SimulatorNode {
 public:
  SimulatorNode(const Params& params, const cmn::SceneWorld& world, const cmn::SensorMounts& mounts)
      : params_{params},
        robot_{world, params.own.simulation, mounts, start_of(params.own, world), params.own.seed},
        simulator_{robot_.simulator()} {
    if (robot_.cameras() != nullptr) {
      cameras_.emplace(nh_, params.own.sensor_frames, params.own.simulation.color.camera());
    } else {
      ROS_WARN_STREAM("there are no cameras: " << robot_.why_no_cameras());
    }
    clock_pub_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 1);
    odom_pub_ = nh_.advertise<nav_msgs::Odometry>("odom", 10);
    scan_pub_ = nh_.advertise<sensor_msgs::LaserScan>("scan", 2);
    truth_pub_ = nh_.advertise<nav_msgs::Odometry>("ground_truth", 10);
    bumper_pub_ = nh_.advertise<std_msgs::Bool>("bumper", 1, true);
    cmd_sub_ = nh_.subscribe("cmd_vel", 1, &SimulatorNode::on_command, this,
                             ros::TransportHints().tcpNoDelay());
    diagnostics_.setHardwareID("simulator");
    diagnostics_.add("world", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
      status.summary(diagnostic_msgs::DiagnosticStatus::OK, params_.own.world);
      status.add("time [s]", simulator_.time_s());
      status.add("collisions", simulator_.collisions());
    });
  }

  void run() {
    const double step_s = 1.0 / params_.own.odometry_rate;
    ros::WallRate rate(params_.own.odometry_rate * params_.own.speed);
    double next_scan_s = 0.0;
    double next_image_s = 0.0;
    while (ros::ok()) {
      ros::spinOnce();
      const bool is_silent = simulator_.time_s() - command_s_ > params_.own.command_timeout_s;
      simulator_.advance(step_s, is_silent ? cmn::VelocityCommand{} : command_);
      publish_state();
      if (simulator_.time_s() >= next_scan_s) {
        publish_scan();
        next_scan_s += 1.0 / params_.own.scan_rate;
        diagnostics_.update();
      }
      if (cameras_ && simulator_.time_s() >= next_image_s) {
        cameras_->publish(*robot_.cameras(), simulator_.truth(), stamp());
        next_image_s += 1.0 / params_.own.camera_rate;
      }
      rate.sleep();
    }
  }

 private:
  void on_command(const geometry_msgs::Twist& twist) {
    if (std::isfinite(twist.linear.x) && std::isfinite(twist.angular.z)) {
      command_ = {twist.linear.x, twist.angular.z};
      command_s_ = simulator_.time_s();
    }
  }

  ros::Time stamp() const { return ros::Time(kEpoch_s + simulator_.time_s()); }

  void publish_state() {
    rosgraph_msgs::Clock clock;
    clock.clock = stamp();
    clock_pub_.publish(clock);

    nav_msgs::Odometry odom;
    odom.header.stamp = clock.clock;
    odom.header.frame_id = params_.frames.odom;
    odom.child_frame_id = params_.frames.base;
    const cmn::Pose2 T_odom_robot = simulator_.odometry().T_odom_robot;
    odom.pose.pose = cmn::pose_message(T_odom_robot);
    odom.twist.twist.linear.x = simulator_.velocity().linear_mps;
    odom.twist.twist.angular.z = simulator_.velocity().angular_radps;
    geometry_msgs::TransformStamped transform;
    transform.header = odom.header;
    transform.child_frame_id = odom.child_frame_id;
    transform.transform = cmn::transform_message(T_odom_robot);
    tf_.sendTransform(transform);
    odom_pub_.publish(odom);

    odom.header.frame_id = "world";
    odom.pose.pose = cmn::pose_message(simulator_.truth());
    truth_pub_.publish(odom);

    std_msgs::Bool bumped;
    bumped.data = static_cast<std::uint8_t>(simulator_.bumped());
    if (bumped.data != was_bumped_) {
      bumper_pub_.publish(bumped);
      was_bumped_ = bumped.data;
    }
  }

  void publish_scan() {
    std_msgs::Header header;
    header.stamp = stamp();
    header.frame_id = params_.own.sensor_frames.laser;
    scan_pub_.publish(cmn::message_of(robot_.scan(), header, 1.0 / params_.own.scan_rate));
  }

  /// Simulated time starts here: time 0 means "no time yet" to ROS.
  static constexpr double kEpoch_s = 1.0;

  ros::NodeHandle nh_;
  Params params_;
  cmn::SimulatedRobot robot_;
  cmn::Simulator& simulator_;  ///< the robot's
  std::optional<cmn::CameraPublisher> cameras_;
  cmn::VelocityCommand command_;
  double command_s_ = -1e9;
  std::uint8_t was_bumped_ = 2;  // neither: the first state is always published
  tf2_ros::TransformBroadcaster tf_;
  ros::Publisher clock_pub_;
  ros::Publisher odom_pub_;
  ros::Publisher scan_pub_;
  ros::Publisher truth_pub_;
  ros::Publisher bumper_pub_;
  ros::Subscriber cmd_sub_;
  diagnostic_updater::Updater diagnostics_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "simulator");
  ros::NodeHandle private_nh("~");
  const auto params = cmn::load_params_or_exit<Params>(private_nh);
  if (params.own.world.empty()) {
    cmn::exit_with({"world: name the world, for example _world:=worlds/home.yaml or house:3"});
  }
  try {
    const cmn::SceneWorld world = cmn::open_scene_world(params.own.world);
    for (const std::string& warning : world.warnings) {
      ROS_WARN_STREAM(warning);
    }
    const cmn::SensorMounts mounts =
        cmn::described_mounts(params.frames.base, params.own.sensor_frames);
    SimulatorNode{params, world, mounts}.run();
  } catch (const std::exception& e) {
    cmn::exit_with({e.what()});
  }
  return 0;
}
