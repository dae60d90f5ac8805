// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/percept_publisher.hpp"

#include "coarse_map_nav/ros/conversions.hpp"

#include <nav_msgs/OccupancyGrid.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Float32.h>

namespace cmn {

PerceptPublisher::PerceptPublisher(ros::NodeHandle& nh, double step_m) : step_m_{step_m} {
  local_pub_ = nh.advertise<coarse_map_nav::LocalOccupancy>("local_occupancy", 1);
  map_pub_ = nh.advertise<coarse_map_nav::LocalOccupancy>("local_map", 1);
  grid_pub_ = nh.advertise<nav_msgs::OccupancyGrid>("local_occupancy/grid", 1);
  blocked_pub_ = nh.advertise<std_msgs::Bool>("obstacle_ahead", 1);
  clear_pub_ = nh.advertise<std_msgs::Float32>("clear_ahead", 1);
  observe_sub_ = nh.subscribe<std_msgs::Empty>("observe", 1, [this](const auto& /*request*/) {
    if (last_) {  // somebody missed it
      local_pub_.publish(*last_);
    }
    if (last_map_) {
      map_pub_.publish(*last_map_);
    }
  });
}

void PerceptPublisher::publish_guard(double clear_ahead_m) {
  std_msgs::Float32 clear;
  clear.data = static_cast<float>(clear_ahead_m);
  clear_pub_.publish(clear);
  std_msgs::Bool blocked;
  blocked.data = static_cast<std::uint8_t>(clear.data < step_m_);
  blocked_pub_.publish(blocked);
}

void PerceptPublisher::publish(const Percept& percept, const std_msgs::Header& header) {
  const auto message_with_guard = [&](const LocalOccupancy& local) {
    coarse_map_nav::LocalOccupancy message = message_of(local, header);
    message.clear_ahead = static_cast<float>(percept.clear_ahead_m);
    message.partial = static_cast<std::uint8_t>(!percept.is_complete);
    return message;
  };
  last_ = message_with_guard(percept.seen);
  local_pub_.publish(*last_);
  last_map_.reset();
  if (percept.local_map.size > 0) {
    last_map_ = message_with_guard(percept.local_map);
    map_pub_.publish(*last_map_);
  }
  if (grid_pub_.getNumSubscribers() > 0) {
    grid_pub_.publish(grid_message(percept.seen, header));
  }
}

}  // namespace cmn
