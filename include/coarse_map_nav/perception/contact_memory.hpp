// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where the robot has bumped into what its sensors do not see.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"

#include <cstddef>
#include <deque>

namespace cmn {

/// A bumper says that something is there, not where along it: the middle of the front is taken.
/// Without such a memory a robot whose LiDAR looks over a bench drives into it again after each
/// turn.
class ContactMemory {
 public:
  /// Of the robot's disc [m].
  explicit ContactMemory(double radius_m) : radius_m_{radius_m} {}

  /// Driving ahead, the robot met something. The oldest of many contacts are forgotten.
  void add(const Pose2& T_odom_robot);
  /// The cells of the contacts become occupied, seen for sure.
  void mark(LocalOccupancy& local, const Pose2& T_odom_robot) const;

 private:
  static constexpr std::size_t kMost = 200;

  double radius_m_;
  std::deque<Point2> contacts_;  ///< [m] in the odometry's frame
};

}  // namespace cmn
