// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How far may the robot move forward?
#pragma once

#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

#include <string>

namespace cmn {

struct ObstacleGuardParams {
  std::string type = "block";
  double side_m = 1.28;          ///< Robb: of the papers' local occupancy
  double occupied_share = 0.25;  ///< Robb: "more than 25 % occupied"
  double radius_m = 0.17;        ///< Kobuki: 0.18
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("type", self.type, OneOf{{"none", "block", "footprint"}},
          "block: no step forward while the block ahead is occupied (Robb); footprint: none that "
          "takes the robot into what is seen (ours); none: any");
    visit("side_m", self.side_m, Between{0.3, 5.0},
          "[m] block: side of the square about the robot whose front block is watched");
    visit("occupied_share", self.occupied_share, Between{0.0, 1.0},
          "[-] block: the way ahead is blocked when more than this share of it is occupied");
    visit("radius_m", self.radius_m, Between{0.02, 2.0},
          "[m] footprint: of the disc that must not meet anything, a little less than the robot's");
  }
};

/// The share of the front middle block that is occupied: a third each way of the square of `side_m`
/// about the robot, or of all that was seen when that is smaller.
///
/// Cells about which nothing is known do not count as occupied: a LiDAR that does not look ahead
/// cannot guard, and the caller learns that from its field of view, not from a robot that stands
/// still. Occupied beyond a hit does count (Robb: everything beyond is occupied).
double occupied_share_ahead(const LocalOccupancy& seen, double side_m);

/// How far a disc of `radius_m` about the robot's middle can go straight ahead until it meets a
/// point that the scan has hit: 0 from where it would at once, infinite when it never would. What
/// lies behind the middle, and what it passes at `radius_m` or more, is not in its way.
double free_way_m(const RangeScan& scan, double radius_m);

/// True when any beam towards the way ahead is a measurement, be it of nothing.
bool sees_ahead(const RangeScan& scan);

/// What the guard allows: no step forward that is longer [m]. 0 or infinite by type "block" (Robb)
/// and infinite by "none". Otherwise 0 for a depth camera that sees nothing ahead: in the dark, and
/// before a wall too near to measure, it has no readings. `seen` was made from `scan`.
double clear_ahead_m(const RangeScan& scan, const LocalOccupancy& seen,
                     const ObstacleGuardParams& params);

}  // namespace cmn
