// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/tf_lookup.hpp"

#include "coarse_map_nav/ros/conversions.hpp"

namespace cmn {

std::optional<Pose2> lookup(const tf2_ros::Buffer& buffer, const std::string& target,
                            const std::string& source, const ros::Time& stamp, std::string& why) {
  std::optional<Pose2> pose;
  try {
    pose = pose_of(buffer.lookupTransform(target, source, stamp).transform);
    why = pose ? "" : "the transform from " + source + " to " + target + " is not a pose";
  } catch (const tf2::TransformException& e) {
    // The exception's text holds times that differ every time: too many reasons to count.
    ROS_DEBUG_STREAM(e.what());
    why = "no transform from " + source + " to " + target;
  }
  return pose;
}

}  // namespace cmn
