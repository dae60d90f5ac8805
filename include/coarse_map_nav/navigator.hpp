// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The whole loop: see, believe, plan, act.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/localization/localizer.hpp"
#include "coarse_map_nav/params.hpp"
#include "coarse_map_nav/perception/contact_memory.hpp"
#include "coarse_map_nav/perception/perception.hpp"
#include "coarse_map_nav/planning/planner.hpp"

#include <memory>
#include <utility>

namespace cmn {

/// One decision of the robot from one look at the world. The nodes do the same over topics.
class Navigator {
 public:
  Navigator(const CoarseMap& map, const NavigatorParams& params)
      : Navigator{map, params, make_localizer(map, params.localization)} {}
  /// With a localizer of the caller's, and what predicts of the perception source "rgb".
  Navigator(const CoarseMap& map, const NavigatorParams& params,
            std::unique_ptr<Localizer> localizer,
            std::shared_ptr<OccupancyPredictor> predictor = nullptr)
      : params_{params},
        perception_{params.perception, std::move(predictor)},
        localizer_{std::move(localizer)},
        planner_{map, params.planning} {}

  Localizer& localizer() { return *localizer_; }
  const Localizer& localizer() const { return *localizer_; }
  Planner& planner() { return planner_; }
  const Planner& planner() const { return planner_; }
  const LocalOccupancy& seen() const { return percept_.seen; }
  const LocalOccupancy& local_map() const { return percept_.local_map; }
  /// What the obstacle guard allows, see clear_ahead_m().
  double clear_ahead_m() const { return percept_.clear_ahead_m; }
  /// The same of what is measured now; folds nothing in.
  double clear_ahead_m(const SensorData& data) { return perception_.clear_ahead_m(data); }
  bool is_blocked_ahead() const { return percept_.clear_ahead_m < params_.planning.step_m; }

  /// `data` was measured at `T_odom_robot`, after the last action had ended with `last_outcome`.
  Decision step(const SensorData& data, const Pose2& T_odom_robot, MotionOutcome last_outcome) {
    return step(look(data, T_odom_robot, last_outcome), T_odom_robot, last_outcome);
  }
  Decision step(const RangeScan& scan, const Pose2& T_odom_robot, MotionOutcome last_outcome) {
    return step(SensorData{&scan}, T_odom_robot, last_outcome);
  }
  /// With an observation for the localizer that does not come from the scan.
  Decision step(const RangeScan& scan, LocalOccupancy seen, const Pose2& T_odom_robot,
                MotionOutcome last_outcome) {
    Percept percept = look(SensorData{&scan}, T_odom_robot, last_outcome);
    percept.seen = std::move(seen);
    return step(std::move(percept), T_odom_robot, last_outcome);
  }
  /// With all that perception makes of its data and of the bumper's contacts. The local map may be
  /// empty where the policy needs none.
  Decision step(Percept percept, const Pose2& T_odom_robot, MotionOutcome last_outcome) {
    percept_ = std::move(percept);
    planner_.action_ended(last_outcome);
    if (!percept_.is_complete) {
      return planner_.look_round(localizer_->localization().axes_yaw_rad);
    }
    localizer_->update(percept_.seen, T_odom_robot);
    return planner_.decide(localizer_->localization(), is_blocked_ahead(), &percept_.local_map);
  }

 private:
  /// A blocked robot has met something.
  Percept look(const SensorData& data, const Pose2& T_odom_robot, MotionOutcome last_outcome) {
    Percept percept = perception_.look(data, T_odom_robot, params_.planning.needs_local_map());
    if (last_outcome == MotionOutcome::kBlocked) {
      contacts_.add(T_odom_robot);
    }
    contacts_.mark(percept.local_map, T_odom_robot);
    return percept;
  }

  NavigatorParams params_;
  Perception perception_;
  ContactMemory contacts_{params_.perception.guard.radius_m};
  std::unique_ptr<Localizer> localizer_;
  Planner planner_;
  Percept percept_;
};

}  // namespace cmn
