// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What perception tells the others.
#pragma once

#include "coarse_map_nav/LocalOccupancy.h"
#include "coarse_map_nav/perception/perception.hpp"

#include <optional>

#include <ros/ros.h>
#include <std_msgs/Header.h>

namespace cmn {

/// Publishes `local_occupancy`, `local_map` and `local_occupancy/grid` of a look, `obstacle_ahead`
/// and `clear_ahead` of the guard, and on `observe` the last look once more.
class PerceptPublisher {
 public:
  /// `step_m`: the way ahead is an obstacle's when less of it is clear.
  PerceptPublisher(ros::NodeHandle& nh, double step_m);

  void publish_guard(double clear_ahead_m);
  /// `header`: of the robot's frame, at the time of the look.
  void publish(const Percept& percept, const std_msgs::Header& header);
  bool has_map_listener() const { return map_pub_.getNumSubscribers() > 0; }

 private:
  double step_m_;
  std::optional<coarse_map_nav::LocalOccupancy> last_;
  std::optional<coarse_map_nav::LocalOccupancy> last_map_;  ///< of the same look
  ros::Publisher local_pub_;
  ros::Publisher grid_pub_;
  ros::Publisher map_pub_;
  ros::Publisher blocked_pub_;
  ros::Publisher clear_pub_;
  ros::Subscriber observe_sub_;
};

}  // namespace cmn
