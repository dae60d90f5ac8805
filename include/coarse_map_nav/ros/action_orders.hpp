// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One action at a time, until the motion controller has answered.
#pragma once

#include "coarse_map_nav/DiscreteAction.h"
#include "coarse_map_nav/MotionResult.h"
#include "coarse_map_nav/data/action.hpp"

#include <cstdint>
#include <functional>

#include <ros/ros.h>
#include <std_msgs/Header.h>

namespace cmn {

/// Publishes `action` and hears `motion_result`.
class ActionOrders {
 public:
  /// `on_end` is told how the last action ended.
  ActionOrders(ros::NodeHandle& nh, std::function<void(MotionOutcome)> on_end);

  /// Orders an action under the id after the last one and `after`, that of a belief.
  void order(const Action& action, std::uint32_t after, const std_msgs::Header& header);
  /// Stays, and awaits nothing any more.
  void stop();
  /// The last order once more, as nobody has answered it.
  void repeat();

  /// 0 before the first order and after stop().
  std::uint32_t id() const { return last_.id; }
  ros::Time sent() const { return sent_; }
  /// True for a look made after the last order was carried out; of an earlier one it says nothing.
  bool has_ended_before(const ros::Time& look) const;

 private:
  std::function<void(MotionOutcome)> on_end_;
  coarse_map_nav::DiscreteAction last_;
  coarse_map_nav::MotionResult ended_;
  ros::Time sent_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
};

}  // namespace cmn
