// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What perception made of the last looks, for a belief that was made from one of them.
#pragma once

#include "coarse_map_nav/LocalOccupancy.h"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/stamped_memory.hpp"

#include <functional>
#include <optional>
#include <string>

#include <ros/ros.h>
#include <std_msgs/Header.h>

namespace cmn {

/// Hears `local_occupancy` for the guard's word and, where it is needed, `local_map`; asks for what
/// is missing by `observe`.
class LookMemory {
 public:
  /// `on_local_map` is called when one has come, `on_partial` when a look has that was only a part
  /// of what can be seen from where the robot stands.
  LookMemory(ros::NodeHandle& nh, bool needs_local_map, std::function<void()> on_local_map,
             std::function<void(const std_msgs::Header&)> on_partial);

  bool needs_local_map() const { return needs_local_map_; }
  /// True unless the look of exactly this time allowed a step of this length.
  bool was_blocked(const ros::Time& stamp, double step_m) const;
  /// Of this look or, where that was lost, the next later one, for a robot that has stood still
  /// since. Empty, and `why` says so, when there is none or it is malformed; never an earlier one.
  std::optional<LocalOccupancy> local_map(const ros::Time& stamp, std::string& why) const;
  /// Perception is to say once more what it saw last.
  void ask();

 private:
  bool needs_local_map_;
  std::function<void()> on_local_map_;
  std::function<void(const std_msgs::Header&)> on_partial_;
  StampedMemory<double> clear_ahead_m_;
  StampedMemory<coarse_map_nav::LocalOccupancy::ConstPtr> local_maps_;
  ros::Publisher observe_pub_;
  ros::Subscriber occupancy_sub_;
  ros::Subscriber local_map_sub_;
};

}  // namespace cmn
