// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A localizer that is told: the upper bound of all others.
#pragma once

#include "coarse_map_nav/localization/localizer.hpp"

namespace cmn {

/// Certain of the pose that it was handed last. Where that lies on an occupied cell of the drawing
/// the belief is on the nearest free one.
class GivenPose : public Localizer {
 public:
  explicit GivenPose(const CoarseMap& map) : map_{map}, belief_{map.width(), map.height()} {}

  /// To be called before each update.
  void place(const Pose2& T_map_robot);
  Correction update(const LocalOccupancy& /*seen*/, const Pose2& /*T_odom_robot*/) override {
    return Correction::kApplied;
  }
  void reset() override {}
  void reset_heading(Heading /*heading*/) override {}
  bool reset_near(const Pose2& T_map_robot, double /*position_sigma_m*/,
                  double /*yaw_sigma_rad*/) override {
    place(T_map_robot);
    return true;
  }
  const CoarseMap& map() const override { return map_; }
  Localization localization() const override {
    return {belief_, estimate_, position_cells_, yaw_rad_, 1.0, true};
  }

 private:
  Cell nearest_free(Cell c) const;

  CoarseMap map_;
  Belief belief_;
  Estimate estimate_;
  Point2 position_cells_;
  double yaw_rad_ = 0.0;
};

}  // namespace cmn
