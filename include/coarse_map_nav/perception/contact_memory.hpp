// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where the robot has bumped into what its sensors do not see.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"

#include <cstddef>
#include <deque>
#include <optional>

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
  /// The cells of the contacts become occupied, seen for sure. To be asked at every look: contacts
  /// of more than kRemembered_m ago are forgotten, since odometry drifts, and a robot may have been
  /// carried; so are those where the robot now stands.
  void mark(LocalOccupancy& local, const Pose2& T_odom_robot);
  /// The odometry begins anew.
  void forget();

  static constexpr double kRemembered_m = 15.0;  ///< of the way driven

 private:
  static constexpr std::size_t kMost = 200;

  struct Contact {
    Point2 position;  ///< [m] in the odometry's frame
    double driven_m;  ///< by then
  };
  void drive_to(Point2 position);

  double radius_m_;
  double driven_m_ = 0.0;
  std::optional<Point2> last_;  ///< where the robot was
  std::deque<Contact> contacts_;
};

}  // namespace cmn
