// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The whole loop: see, believe, plan, act.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/localization/belief_filter.hpp"
#include "coarse_map_nav/params.hpp"
#include "coarse_map_nav/perception/obstacle_guard.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"
#include "coarse_map_nav/planning/planner.hpp"

namespace cmn {

/// One decision of the robot from one look at the world. The nodes do the same over topics.
class Navigator {
 public:
  Navigator(const CoarseMap& map, const NavigatorParams& params)
      : params_{params},
        projector_{params.perception.local_occupancy},
        filter_{map, params.localization},
        planner_{map, params.planning} {}

  BeliefFilter& filter() { return filter_; }
  Planner& planner() { return planner_; }
  const LocalOccupancy& seen() const { return seen_; }

  /// `scan` was taken at `T_odom_robot`, after the last action had ended with `last_outcome`.
  Decision step(const RangeScan& scan, const Pose2& T_odom_robot, MotionOutcome last_outcome) {
    planner_.action_ended(last_outcome);
    seen_ = projector_.project(scan);
    filter_.update(seen_, T_odom_robot);
    return planner_.decide(
        {filter_.belief(), filter_.estimate(), filter_.confidence(), filter_.is_converged()},
        is_blocked_ahead(seen_, params_.perception.guard));
  }

 private:
  NavigatorParams params_;
  RangeProjector projector_;
  BeliefFilter filter_;
  Planner planner_;
  LocalOccupancy seen_;
};

}  // namespace cmn
