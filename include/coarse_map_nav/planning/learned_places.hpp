// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What was learned about the drawing belongs to the belief under which it was learned.
#pragma once

#include "coarse_map_nav/data/action.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/planning/map_repair.hpp"

#include <deque>

namespace cmn {

/// Tells by the robot's own count of its actions when an estimate is not where the last one leads
/// to: one of the two is wrong, and with it all that was learned there (ours). What was learned is
/// then set aside, and taken up again if the robot comes to believe again what it believed then.
class LearnedPlaces {
 public:
  /// An action was ordered, and is taken for done.
  void moved(ActionType action, double step_m);
  /// The step that moved() took for done was not.
  void was_stuck(double step_m);
  /// The robot is sure to be at `position_cells` of the drawing, its x axis along `yaw_rad` of the
  /// grid; a metre on the ground is `cells_per_m` cells. `map` then holds what was learned under
  /// this belief. True when it held something else.
  bool arrive(RepairedMap& map, Point2 position_cells, double yaw_rad, double cells_per_m);
  /// The next estimate is that of the belief held, wherever it is: who knows who moved the robot.
  void expect_anywhere() { is_anywhere_ = true; }
  void forget_failures();

  /// Farther off than this, and a share of the way since, is another place.
  static constexpr double kJump_m = 1.0;
  static constexpr double kDrift = 0.1;
  static constexpr double kMostDrift_m = 1.0;
  static constexpr std::size_t kMostSetAside = 4;

 private:
  /// A belief: where the robot took itself to be when, by its own count, it stood there.
  struct Place {
    Pose2 T_count_robot;
    double way_m = 0.0;
    Point2 position_cells;
    double yaw_rad = 0.0;
    RepairedMap::Learned learned;  ///< while set aside
  };
  bool agrees(const Place& place, Point2 position_cells, double yaw_rad, double cells_per_m) const;

  Pose2 T_count_robot_;  ///< by the actions that were ordered [m]
  double way_m_ = 0.0;
  bool is_anywhere_ = true;
  Place held_;
  std::deque<Place> set_aside_;  ///< the last one first
};

}  // namespace cmn
