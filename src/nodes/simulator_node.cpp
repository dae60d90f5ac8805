// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmd_vel -> scan, odom, TF, /clock: a base with a LiDAR in a planar world. Where the LiDAR is
/// says robot_description, from which robot_state_publisher has the transforms that do not change.

#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/mapping/places.hpp"
#include "coarse_map_nav/ros/conversions.hpp"
#include "coarse_map_nav/ros/node.hpp"
#include "coarse_map_nav/ros/node_params.hpp"
#include "coarse_map_nav/simulation/robot_description.hpp"
#include "coarse_map_nav/simulation/simulator.hpp"

#include <cmath>
#include <exception>
#include <limits>
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
/// the world's list of starts or, without one, anywhere that the robot fits; one of four headings.
cmn::Pose2 start_of(const cmn::SimulatorNodeParams& own, const cmn::World& world) {
  std::mt19937 rng{own.seed};
  std::optional<cmn::Pose2> start =
      world.random_free_pose(own.simulation.robot.radius_m + 0.05, rng);
  if (!start) {
    throw std::runtime_error(own.world + ": the robot fits nowhere in this world");
  }
  const std::vector<cmn::Point2> starts = cmn::read_starts(own.world);
  if (!starts.empty()) {
    const cmn::Point2 place = starts[rng() % starts.size()];
    start = cmn::Pose2{place.x, place.y, start->yaw};
  }
  return {std::isnan(own.start_x) ? start->x : own.start_x,
          std::isnan(own.start_y) ? start->y : own.start_y,
          std::isnan(own.start_yaw_deg) ? start->yaw : own.start_yaw_deg * cmn::kPi / 180.0};
}

/// From the parameter that robot_state_publisher reads too, sought as it does: in the namespace of
/// the node, then further out.
cmn::SensorMounts mounts_of(const Params& params) {
  std::string key;
  std::string xml;
  if (!ros::param::search("robot_description", key) || !ros::param::get(key, xml)) {
    throw std::runtime_error(
        "robot_description: there is no such parameter; launch/include/robot.launch sets it");
  }
  return cmn::mounts_of(cmn::parse_robot_description(xml, key), params.frames.base,
                        params.own.sensor_frames);
}

class SimulatorNode {
 public:
  SimulatorNode(const Params& params, cmn::World world, const cmn::Pose2& start)
      : params_{params},
        simulator_{std::move(world), params.own.simulation, start, params.own.seed,
                   cmn::seen_from_above(mounts_of(params).T_robot_lidar)} {
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
    scan_pub_.publish(cmn::message_of(simulator_.scan(), header, 1.0 / params_.own.scan_rate));
  }

  /// Simulated time starts here: time 0 means "no time yet" to ROS.
  static constexpr double kEpoch_s = 1.0;

  ros::NodeHandle nh_;
  Params params_;
  cmn::Simulator simulator_;
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
    cmn::exit_with({"world: name the file of the world, for example _world:=worlds/home.yaml"});
  }
  try {
    const cmn::World world{cmn::read_map(params.own.world)};
    const cmn::Pose2 start = start_of(params.own, world);
    SimulatorNode{params, world, start}.run();
  } catch (const std::exception& e) {
    cmn::exit_with({e.what()});
  }
  return 0;
}
