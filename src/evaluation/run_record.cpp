// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/run_record.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cmn {

void RunRecord::add(RunMoment moment) {
  // The last one is always there, though it may only stand in for the next that is to be kept.
  const bool is_stand_in = !moments_.empty() && (seen_ - 1) % stride_ != 0;
  if (is_stand_in) {
    moments_.back() = std::move(moment);
  } else {
    moments_.push_back(std::move(moment));
  }
  ++seen_;
  if (moments_.size() > kMostMoments) {
    static_assert(kMostMoments % 2 == 0, "the last moment has an even index and stays");
    for (std::size_t i = 1; 2 * i < moments_.size(); ++i) {
      moments_[i] = std::move(moments_[2 * i]);
    }
    moments_.resize(kMostMoments / 2 + 1);
    stride_ *= 2;
  }
}

void RunRecord::add(const TrackPoint& point) {
  if (!track_.empty()) {
    const TrackPoint& last = track_.back();
    const double moved_m = norm(point.T_world_robot.position() - last.T_world_robot.position());
    const double turned_rad =
        std::abs(wrap_angle(point.T_world_robot.yaw - last.T_world_robot.yaw));
    if (moved_m < 0.02 && turned_rad < 5.0 * kPi / 180.0 && point.time_s - last.time_s < 1.0) {
      return;
    }
    driven_m_ += moved_m;
  }
  track_.push_back(point);
}

std::optional<Pose2> RunRecord::truth_at(double time_s) const {
  const auto last = std::find_if(track_.rbegin(), track_.rend(),
                                 [&](const TrackPoint& point) { return point.time_s <= time_s; });
  return last == track_.rend() ? std::nullopt : std::optional<Pose2>{last->T_world_robot};
}

double RunRecord::duration_s() const {
  return std::max(moments_.empty() ? 0.0 : moments_.back().time_s,
                  track_.empty() ? 0.0 : track_.back().time_s);
}

}  // namespace cmn
