// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/tf_lookup.hpp"

#include "coarse_map_nav/ros/camera_conversions.hpp"
#include "coarse_map_nav/ros/conversions.hpp"

namespace cmn {

namespace {

/// What `pose_of` makes of a transform; empty, and `why` says so, when there is none.
template <class PoseOf>
auto look_up(const tf2_ros::Buffer& buffer, const std::string& target, const std::string& source,
             const ros::Time& stamp, std::string& why, PoseOf&& pose_of)
    -> decltype(pose_of(geometry_msgs::Transform{})) {
  try {
    const auto pose = pose_of(buffer.lookupTransform(target, source, stamp).transform);
    why = pose ? "" : "the transform from " + source + " to " + target + " is not a pose";
    return pose;
  } catch (const tf2::TransformException& e) {
    // The exception's text holds times that differ every time: too many reasons to count.
    ROS_DEBUG_STREAM(e.what());
    why = "no transform from " + source + " to " + target;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Pose2> lookup(const tf2_ros::Buffer& buffer, const std::string& target,
                            const std::string& source, const ros::Time& stamp, std::string& why) {
  return look_up(buffer, target, source, stamp, why,
                 [](const geometry_msgs::Transform& transform) { return pose_of(transform); });
}

std::optional<Eigen::Isometry3d> lookup_mount(const tf2_ros::Buffer& buffer,
                                              const std::string& target, const std::string& source,
                                              const ros::Time& stamp, std::string& why) {
  return look_up(buffer, target, source, stamp, why, isometry_of);
}

}  // namespace cmn
