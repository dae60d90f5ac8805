// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The transforms of a robot with a camera and a LiDAR.
#pragma once

#include "coarse_map_nav/ros/conversions.hpp"

#include <vector>

#include <Eigen/Geometry>
#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

namespace cmn {

class RobotTransforms {
 public:
  /// Frames camera and laser, the latter in the robot's middle.
  void mount_sensors(const Eigen::Isometry3d& T_robot_camera) {
    geometry_msgs::TransformStamped camera;
    camera.header.stamp = ros::Time::now();
    camera.header.frame_id = "base_link";
    camera.child_frame_id = "camera";
    const Eigen::Quaterniond q{T_robot_camera.linear()};
    camera.transform.rotation.x = q.x();
    camera.transform.rotation.y = q.y();
    camera.transform.rotation.z = q.z();
    camera.transform.rotation.w = q.w();
    camera.transform.translation.x = T_robot_camera.translation().x();
    camera.transform.translation.z = T_robot_camera.translation().z();
    geometry_msgs::TransformStamped laser = camera;
    laser.child_frame_id = "laser";
    laser.transform = transform_message({});
    mounts_.sendTransform(std::vector<geometry_msgs::TransformStamped>{camera, laser});
  }
  void send_odometry(const ros::Time& stamp, const Pose2& T_odom_robot) {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = stamp;
    transform.header.frame_id = "odom";
    transform.child_frame_id = "base_link";
    transform.transform = transform_message(T_odom_robot);
    odometry_.sendTransform(transform);
  }

 private:
  tf2_ros::StaticTransformBroadcaster mounts_;
  tf2_ros::TransformBroadcaster odometry_;
};

}  // namespace cmn
