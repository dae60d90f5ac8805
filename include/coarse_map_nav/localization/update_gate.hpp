// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Which observations to fold in.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/param_tree.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace cmn {

struct UpdateGateParams {
  std::string update_on = "action";
  double update_distance_m = 0.15;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("update_on", self.update_on, OneOf{{"action", "motion"}},
          "action: once after each action of the planner; motion: whenever the robot has moved, "
          "whoever drives it (recorded data, a joystick)");
    visit("update_distance_m", self.update_distance_m, Between{0.01, 10.0},
          "[m] update_on motion: at least so far between updates, or a quarter turn");
  }
};

/// The cycle: action -> motion result -> an observation newer than it -> belief with its id.
///
/// Two looks from the same spot are not independent evidence, so each stop counts once.
class UpdateGate {
 public:
  explicit UpdateGate(const UpdateGateParams& params) : params_{params} {}

  /// The next observation is folded in, whatever came before.
  void reset() { T_odom_last_.reset(); }
  /// An action has ended; `stamp_s` is the time of the odometry that ended it. False, and nothing
  /// becomes due, when that very end is folded in already: the answer was repeated.
  bool action_ended(std::uint32_t id, double stamp_s);
  /// True, and remembered, when this observation is to be folded in.
  bool is_due(double stamp_s, const Pose2& T_odom_robot);
  /// Time has gone backwards: the bag was started again, the simulation reset.
  bool time_jumped_back(double stamp_s);
  /// An action has ended that no observation has followed yet.
  bool is_waiting() const { return ended_.has_value(); }
  /// The last action folded in, 0 before the first.
  std::uint32_t action_id() const { return folded_in_.id; }

 private:
  struct Ended {
    std::uint32_t id;
    double stamp_s;
    bool operator==(const Ended& other) const { return id == other.id && stamp_s == other.stamp_s; }
  };
  UpdateGateParams params_;
  std::optional<Pose2> T_odom_last_;
  std::optional<double> last_stamp_s_;
  std::optional<Ended> ended_;
  static constexpr double kNever_s = -1.0;
  Ended folded_in_{0, kNever_s};
};

}  // namespace cmn
