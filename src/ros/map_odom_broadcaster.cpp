// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/map_odom_broadcaster.hpp"

#include "coarse_map_nav/ros/conversions.hpp"

#include <utility>

#include <geometry_msgs/TransformStamped.h>

namespace cmn {

MapOdomBroadcaster::MapOdomBroadcaster(std::string map_frame, std::string odom_frame,
                                       double tolerance_s)
    : map_frame_{std::move(map_frame)},
      odom_frame_{std::move(odom_frame)},
      tolerance_{tolerance_s} {}

void MapOdomBroadcaster::send(const ros::Time& observed) {
  if (observed == last_) {  // perception repeats itself when it is asked to
    return;
  }
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = observed + tolerance_;
  transform.header.frame_id = map_frame_;
  transform.child_frame_id = odom_frame_;
  transform.transform = transform_message(T_map_odom_);
  broadcaster_.sendTransform(transform);
  last_ = observed;
}

}  // namespace cmn
