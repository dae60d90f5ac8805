// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The transform from the drawing to the odometry.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <string>

#include <ros/time.h>
#include <tf2_ros/transform_broadcaster.h>

namespace cmn {

/// Broadcasts map -> odom as amcl does (REP-105): so that the robot's pose in the map frame, in
/// metres of the drawing, is the estimate's at the time of an update.
///
/// A rigid transform knows no scale: between updates the robot moves on the drawing by as many
/// metres as on the ground, and each update puts right what that is off where the drawing is not to
/// scale.
class MapOdomBroadcaster {
 public:
  MapOdomBroadcaster(std::string map_frame, std::string odom_frame, double tolerance_s);

  void set(const Pose2& T_map_odom) { T_map_odom_ = T_map_odom; }
  /// Stamps it ahead of an observation's time, once for each.
  void send(const ros::Time& observed);

 private:
  std::string map_frame_;
  std::string odom_frame_;
  ros::Duration tolerance_;
  Pose2 T_map_odom_;
  ros::Time last_;
  tf2_ros::TransformBroadcaster broadcaster_;
};

}  // namespace cmn
