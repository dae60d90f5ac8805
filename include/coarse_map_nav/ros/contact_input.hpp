// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the bumper meets, as obstacles on the local map.
#pragma once

#include "coarse_map_nav/perception/contact_memory.hpp"
#include "coarse_map_nav/ros/bumper.hpp"
#include "coarse_map_nav/ros/node_params.hpp"

#include <tf2_ros/buffer.h>

namespace cmn {

/// Hears `bumper`; a robot without one sends nothing, and nothing is marked.
class ContactInput {
 public:
  /// `radius_m`: of the robot's disc.
  ContactInput(ros::NodeHandle& nh, tf2_ros::Buffer& buffer, const FrameParams& frames,
               double radius_m);

  /// Once a look. Where the robot is says the newest odometry: who decides on the map stands still.
  void mark(LocalOccupancy& local_map);
  /// The odometry begins anew.
  void forget() { memory_.forget(); }

 private:
  tf2_ros::Buffer& buffer_;
  FrameParams frames_;
  Bumper bumper_;
  bool was_pressed_ = false;
  ContactMemory memory_;
};

}  // namespace cmn
