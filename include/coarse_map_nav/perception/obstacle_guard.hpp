// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// May the robot move forward?
#pragma once

#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/param_tree.hpp"

#include <cstddef>
#include <map>

namespace cmn {

struct ObstacleGuardParams {
  double side_m = 1.28;          ///< Robb: of the papers' local occupancy
  double occupied_share = 0.25;  ///< Robb: "more than 25 % occupied"
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("side_m", self.side_m, Between{0.3, 5.0},
          "[m] side of the square about the robot whose front block is watched");
    visit("occupied_share", self.occupied_share, Between{0.0, 1.0},
          "[-] the way ahead is blocked when more than this share of the front block is occupied");
  }
};

/// The share of the front middle block that is occupied: a third each way of the square of `side_m`
/// about the robot, or of all that was seen when that is smaller.
///
/// Cells about which nothing is known do not count as occupied: a LiDAR that does not look ahead
/// cannot guard, and the caller learns that from its field of view, not from a robot that stands
/// still. Occupied beyond a hit does count (Robb: everything beyond is occupied).
double occupied_share_ahead(const LocalOccupancy& seen, double side_m);

/// Robb: the front block is more than `occupied_share` occupied.
bool is_blocked_ahead(const LocalOccupancy& seen, const ObstacleGuardParams& params);

/// The guard's word on the last observations, for a belief that was made from one of them.
class GuardMemory {
 public:
  void remember(double stamp_s, bool is_blocked);
  /// What was said of the observation of exactly this time; one not remembered is not safe: true.
  bool was_blocked(double stamp_s) const;

 private:
  static constexpr std::size_t kObservations = 30;  ///< 3 s of a LiDAR
  std::map<double, bool> blocked_at_;
};

}  // namespace cmn
