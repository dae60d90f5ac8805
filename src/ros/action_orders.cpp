// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/action_orders.hpp"

#include "coarse_map_nav/ros/conversions.hpp"

#include <algorithm>
#include <utility>

namespace cmn {

ActionOrders::ActionOrders(ros::NodeHandle& nh, std::function<void(MotionOutcome)> on_end)
    : on_end_{std::move(on_end)} {
  pub_ = nh.advertise<coarse_map_nav::DiscreteAction>("action", 1);
  sub_ = nh.subscribe<coarse_map_nav::MotionResult>("motion_result", 5, [this](const auto& msg) {
    if (msg->id == last_.id) {
      ended_ = *msg;
      on_end_(static_cast<MotionOutcome>(msg->outcome));
    }
  });
}

void ActionOrders::order(const Action& action, std::uint32_t after,
                         const std_msgs::Header& header) {
  last_ = message_of(action, std::max(last_.id, after) + 1, header);
  repeat();
}

void ActionOrders::stop() {
  last_ = {};
  pub_.publish(last_);
}

void ActionOrders::repeat() {
  pub_.publish(last_);
  sent_ = ros::Time::now();
}

bool ActionOrders::has_ended_before(const ros::Time& look) const {
  return last_.id == 0 || (ended_.id == last_.id && look > ended_.header.stamp);
}

}  // namespace cmn
