// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/learned_places.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cmn {

void LearnedPlaces::moved(ActionType action, double step_m) {
  const double ahead_m = action == ActionType::kMoveForward ? step_m : 0.0;
  T_count_robot_ = T_count_robot_ * Pose2{ahead_m, 0.0, quarter_turns(action) * kPi / 2.0};
  way_m_ += ahead_m;
}

void LearnedPlaces::was_stuck(double step_m) {
  T_count_robot_ = T_count_robot_ * Pose2{-step_m, 0.0, 0.0};
  way_m_ -= step_m;
}

bool LearnedPlaces::agrees(const Place& place, Point2 position_cells, double yaw_rad,
                           double cells_per_m) const {
  const double turned_rad = T_count_robot_.yaw - place.T_count_robot.yaw;
  if (std::abs(std::remainder(yaw_rad - place.yaw_rad - turned_rad, 2.0 * kPi)) > kPi / 4.0) {
    return false;
  }
  const Point2 gone = turned(T_count_robot_.position() - place.T_count_robot.position(),
                             place.yaw_rad - place.T_count_robot.yaw);
  const double off_m = norm((1.0 / cells_per_m) * (position_cells - place.position_cells) - gone);
  return off_m <= kJump_m + std::min(kDrift * (way_m_ - place.way_m), kMostDrift_m);
}

bool LearnedPlaces::arrive(RepairedMap& map, Point2 position_cells, double yaw_rad,
                           double cells_per_m) {
  const bool has_jumped = !is_anywhere_ && !agrees(held_, position_cells, yaw_rad, cells_per_m);
  is_anywhere_ = false;
  if (has_jumped) {
    const auto known = std::find_if(set_aside_.begin(), set_aside_.end(), [&](const Place& place) {
      return agrees(place, position_cells, yaw_rad, cells_per_m);
    });
    RepairedMap::Learned learned;
    if (known != set_aside_.end()) {
      learned = std::move(known->learned);
      set_aside_.erase(known);
    }
    held_.learned = map.exchange(learned);
    set_aside_.push_front(std::move(held_));
    set_aside_.resize(std::min(set_aside_.size(), kMostSetAside));
  }
  held_ = {T_count_robot_, way_m_, position_cells, yaw_rad, {}};
  return has_jumped;
}

void LearnedPlaces::forget_failures() {
  for (Place& place : set_aside_) {
    place.learned.forget_failures();
  }
}

}  // namespace cmn
