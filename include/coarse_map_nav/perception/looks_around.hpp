// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Looks that a robot makes while it turns on one spot.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace cmn {

/// The last look at each heading from one spot; a step away begins anew.
///
/// Complete when four headings of the same axes have been looked at and the robot faces the first
/// of them again, so that looking round has not turned it; from then on it may turn on the spot and
/// stays complete. Looks are to be made at rest.
template <class Seen>
class LooksAround {
 public:
  struct Look {
    Seen seen;
    Pose2 T_odom_robot;
  };

  void add(Seen seen, const Pose2& T_odom_robot) {
    if (looks_.empty() || norm(T_odom_robot.position() - spot_) > kSpot_m) {
      forget();
      spot_ = T_odom_robot.position();
    }
    const auto same = std::find_if(looks_.begin(), looks_.end(), [&](const Look& other) {
      return std::abs(wrap_angle(other.T_odom_robot.yaw - T_odom_robot.yaw)) < kHeading_rad;
    });
    if (same != looks_.end()) {
      *same = {std::move(seen), T_odom_robot};
    } else {
      if (looks_.size() == kMostLooks) {
        looks_.erase(looks_.begin());
      }
      looks_.push_back({std::move(seen), T_odom_robot});
    }
    is_complete_ = is_complete_ || has_four_and_faces_the_first(T_odom_robot.yaw);
  }
  /// The odometry jumped.
  void forget() {
    looks_.clear();
    is_complete_ = false;
  }
  bool is_complete() const { return is_complete_; }
  /// In the order in which their headings were first seen.
  const std::vector<Look>& looks() const { return looks_; }

  /// Less than that is no step away, and no turn off a heading.
  static constexpr double kSpot_m = 0.05;
  static constexpr double kHeading_rad = 10.0 * kPi / 180.0;
  /// Four, and some from other axes: a robot starts out anywhere and turns onto its axes.
  static constexpr std::size_t kMostLooks = 8;

 private:
  bool has_four_and_faces_the_first(double yaw_rad) const {
    std::vector<int> quarters;  // of the looks of the robot's axes, from its heading on
    for (const Look& look : looks_) {
      const double turn_rad = wrap_angle(look.T_odom_robot.yaw - yaw_rad);
      const int quarter = nearest_quarter(turn_rad);
      if (std::abs(turn_rad - quarter * kPi / 2.0) < kHeading_rad) {
        quarters.push_back((quarter + 4) % 4);
      }
    }
    return quarters.size() == 4 && quarters.front() == 0;
  }

  std::vector<Look> looks_;
  Point2 spot_;
  bool is_complete_ = false;
};

}  // namespace cmn
