// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/update_gate.hpp"

namespace cmn {

bool UpdateGate::action_ended(std::uint32_t id, double stamp_s) {
  const Ended ended{id, stamp_s};
  if (ended == folded_in_) {
    return false;
  }
  ended_ = ended;
  return true;
}

bool UpdateGate::is_due(double stamp_s, const Pose2& T_odom_robot) {
  bool due = !T_odom_last_.has_value();
  if (ended_ && stamp_s > ended_->stamp_s) {
    folded_in_ = *ended_;
    ended_.reset();
    due = true;
  } else if (!due && params_.update_on == "motion") {
    const Displacement driven = displacement(*T_odom_last_, T_odom_robot);
    due = driven.quarter_turns != 0 ||
          std::hypot(driven.forward_m, driven.left_m) >= params_.update_distance_m;
  }
  if (due) {
    T_odom_last_ = T_odom_robot;
  }
  return due;
}

bool UpdateGate::time_jumped_back(double stamp_s) {
  // Neighbouring messages may swap places; a second is no such thing.
  const bool jumped = last_stamp_s_ && stamp_s < *last_stamp_s_ - 1.0;
  if (jumped) {
    ended_.reset();
    folded_in_.stamp_s = kNever_s;  // a bag that is played again ends its actions at the same times
  }
  if (jumped || !last_stamp_s_ || stamp_s > *last_stamp_s_) {
    last_stamp_s_ = stamp_s;
  }
  return jumped;
}

}  // namespace cmn
