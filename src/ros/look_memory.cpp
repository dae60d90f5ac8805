// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/look_memory.hpp"

#include "coarse_map_nav/ros/conversions.hpp"

#include <utility>

#include <std_msgs/Empty.h>

namespace cmn {

LookMemory::LookMemory(ros::NodeHandle& nh, bool needs_local_map,
                       std::function<void()> on_local_map,
                       std::function<void(const std_msgs::Header&)> on_partial)
    : needs_local_map_{needs_local_map},
      on_local_map_{std::move(on_local_map)},
      on_partial_{std::move(on_partial)} {
  using Message = coarse_map_nav::LocalOccupancy;
  observe_pub_ = nh.advertise<std_msgs::Empty>("observe", 1);
  occupancy_sub_ = nh.subscribe<Message>("local_occupancy", 5, [this](const auto& msg) {
    clear_ahead_m_.remember(msg->header.stamp.toSec(), static_cast<double>(msg->clear_ahead));
    if (msg->partial != 0) {
      on_partial_(msg->header);
    }
  });
  if (needs_local_map) {
    local_map_sub_ = nh.subscribe<Message>("local_map", 5, [this](const auto& msg) {
      if (msg->partial == 0) {
        local_maps_.remember(msg->header.stamp.toSec(), msg);
        on_local_map_();
      }
    });
  }
}

bool LookMemory::was_blocked(const ros::Time& stamp, double step_m) const {
  const double* const clear_m = clear_ahead_m_.at(stamp.toSec());
  return clear_m == nullptr || !(*clear_m >= step_m);
}

std::optional<LocalOccupancy> LookMemory::local_map(const ros::Time& stamp,
                                                    std::string& why) const {
  const auto* const seen = local_maps_.at_or_after(stamp.toSec());
  if (seen == nullptr) {
    why = "there is none since the belief";
    return std::nullopt;
  }
  return local_occupancy_of(**seen, why);
}

void LookMemory::ask() { observe_pub_.publish(std_msgs::Empty{}); }

}  // namespace cmn
