// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether two looks can be of the same place.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"

namespace cmn {

/// Of the surfaces of a look that lie in view of the other, the share that stands amid what the
/// other saw to be free, 0.3 m from anything else; of both looks the lesser, since glass, a door or
/// somebody who walks in changes one of them; and of some turns that odometry may have missed, the
/// least. About 0 for two looks of one place, whatever was hidden in the one or the other; 0, too,
/// where there is too little to compare. `T_before_now`: the pose of the robot at the later look in
/// its frame at the earlier one, by odometry.
double contradiction(const LocalOccupancy& before, const LocalOccupancy& now,
                     const Pose2& T_before_now);

/// contradiction() of each look and the one before; 0 of the first.
class LookComparison {
 public:
  double next(const LocalOccupancy& look, const Pose2& T_odom_robot);

 private:
  LocalOccupancy last_;
  Pose2 T_odom_last_;
};

}  // namespace cmn
