// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The whole loop: see, believe, plan, act.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/localization/localizer.hpp"
#include "coarse_map_nav/params.hpp"
#include "coarse_map_nav/perception/obstacle_guard.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"
#include "coarse_map_nav/planning/planner.hpp"

#include <memory>
#include <utility>

namespace cmn {

/// One decision of the robot from one look at the world. The nodes do the same over topics.
class Navigator {
 public:
  Navigator(const CoarseMap& map, const NavigatorParams& params)
      : Navigator{map, params, make_localizer(map, params.localization)} {}
  /// With a localizer of the caller's.
  Navigator(const CoarseMap& map, const NavigatorParams& params,
            std::unique_ptr<Localizer> localizer)
      : params_{params},
        projector_{params.perception.local_occupancy},
        local_map_projector_{params.perception.local_map},
        rolling_seen_{params.perception.rolling},
        rolling_local_map_{params.perception.rolling},
        localizer_{std::move(localizer)},
        planner_{map, params.planning} {}

  Localizer& localizer() { return *localizer_; }
  const Localizer& localizer() const { return *localizer_; }
  Planner& planner() { return planner_; }
  const Planner& planner() const { return planner_; }
  const LocalOccupancy& seen() const { return seen_; }
  const LocalOccupancy& local_map() const { return local_map_; }
  /// What the obstacle guard allows, see clear_ahead_m().
  double clear_ahead_m() const { return clear_ahead_m_; }
  bool is_blocked_ahead() const { return clear_ahead_m_ < params_.planning.step_m; }

  /// `scan` was taken at `T_odom_robot`, after the last action had ended with `last_outcome`.
  Decision step(const RangeScan& scan, const Pose2& T_odom_robot, MotionOutcome last_outcome) {
    return step(scan, projector_.project(scan), T_odom_robot, last_outcome);
  }
  /// With an observation for the localizer that does not come from the scan.
  Decision step(const RangeScan& scan, LocalOccupancy seen, const Pose2& T_odom_robot,
                MotionOutcome last_outcome) {
    const double clear_m = cmn::clear_ahead_m(scan, seen, params_.perception.guard);
    const bool is_rolling = params_.perception.accumulate == "rolling";
    LocalOccupancy local_map;
    if (params_.planning.needs_local_map()) {
      local_map = local_map_projector_.project(scan);
      if (is_rolling) {
        local_map = rolling_local_map_.fuse(local_map, T_odom_robot);
      }
    }
    if (is_rolling) {
      seen = rolling_seen_.fuse(seen, T_odom_robot);
    }
    return step(std::move(seen), std::move(local_map), clear_m, T_odom_robot, last_outcome);
  }
  /// With all that perception makes of a scan. `local_map` may be empty where the policy needs
  /// none.
  Decision step(LocalOccupancy seen, LocalOccupancy local_map, double clear_ahead_m,
                const Pose2& T_odom_robot, MotionOutcome last_outcome) {
    planner_.action_ended(last_outcome);
    seen_ = std::move(seen);
    local_map_ = std::move(local_map);
    clear_ahead_m_ = clear_ahead_m;
    localizer_->update(seen_, T_odom_robot);
    return planner_.decide(localizer_->localization(), is_blocked_ahead(), &local_map_);
  }

 private:
  NavigatorParams params_;
  RangeProjector projector_;
  RangeProjector local_map_projector_;
  RollingMap rolling_seen_;
  RollingMap rolling_local_map_;
  std::unique_ptr<Localizer> localizer_;
  Planner planner_;
  LocalOccupancy seen_;
  LocalOccupancy local_map_;
  double clear_ahead_m_ = 0.0;
};

}  // namespace cmn
