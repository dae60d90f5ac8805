// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Poses out of TF.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <optional>
#include <string>

#include <Eigen/Geometry>
#include <ros/time.h>
#include <tf2_ros/buffer.h>

namespace cmn {

/// The pose of frame `source` in frame `target` at `stamp`, without waiting. Empty, and `why` says
/// so, when TF does not know it or what it knows is no pose; never an identity in its place.
std::optional<Pose2> lookup(const tf2_ros::Buffer& buffer, const std::string& target,
                            const std::string& source, const ros::Time& stamp, std::string& why);
/// The same in space, of a sensor on the robot.
std::optional<Eigen::Isometry3d> lookup_mount(const tf2_ros::Buffer& buffer,
                                              const std::string& target, const std::string& source,
                                              const ros::Time& stamp, std::string& why);

}  // namespace cmn
