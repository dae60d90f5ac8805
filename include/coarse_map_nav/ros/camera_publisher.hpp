// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the cameras of a simulated robot see, as its drivers would send it.
#pragma once

#include "coarse_map_nav/simulation/robot_description.hpp"
#include "coarse_map_nav/simulation/scene_sensors.hpp"

#include <ros/ros.h>

namespace cmn {

/// `depth/image`, `camera_info` and `points` of the depth camera, `image` and `image/camera_info`
/// of the colour camera: all of one moment. Only what somebody listens to is made.
class CameraPublisher {
 public:
  /// A camera whose frame is empty is none: its topics are not advertised.
  CameraPublisher(ros::NodeHandle& nh, const SensorFrameParams& frames, const CameraModel& color);

  void publish(SceneSensors& sensors, const Pose2& T_world_robot, const ros::Time& stamp);

 private:
  SensorFrameParams frames_;
  CameraModel color_;
  ros::Publisher info_pub_;
  ros::Publisher depth_pub_;
  ros::Publisher cloud_pub_;
  ros::Publisher image_info_pub_;
  ros::Publisher image_pub_;
};

}  // namespace cmn
