// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where am I on the drawing: the seam between the filters of the papers and ours.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/localization.hpp"

#include <memory>

namespace cmn {

/// What one look at the world did to the belief.
enum class Correction { kApplied, kContradiction, kReopened };

class Localizer {
 public:
  virtual ~Localizer() = default;
  /// Folds in one observation and the odometry since the one before. The first call after a start
  /// or a reset only corrects.
  virtual Correction update(const LocalOccupancy& seen, const Pose2& T_odom_robot) = 0;
  /// Starts over, anywhere on the drawing. The odometry goes on in its frame.
  virtual void reset() = 0;
  /// Likewise at a known heading (CMN).
  virtual void reset_heading(Heading heading) = 0;
  /// Likewise near a pose of the map frame: Gaussian in position and over the headings. False, and
  /// nothing changed, when no free cell is near.
  virtual bool reset_near(const Pose2& T_map_robot, double position_sigma_m,
                          double yaw_sigma_rad) = 0;
  virtual const CoarseMap& map() const = 0;
  /// Good until the next call of update().
  virtual Localization localization() const = 0;
};

/// The finer pose of a localization, in metres of the drawing.
Pose2 pose_in_map(const CoarseMap& map, const Localization& localization);

/// What weight a pose's neighbourhood gives a state, its yaw in the axes of the grid: sigmas of at
/// least half a cell and 0.1 rad; 0 beyond five sigmas.
double weight_near(const Pose2& T_map_robot, double position_sigma_m, double yaw_sigma_rad,
                   const CoarseMap& map, double yaw_rad, Cell cell);
inline double weight_near(const Pose2& T_map_robot, double position_sigma_m, double yaw_sigma_rad,
                          const CoarseMap& map, Heading heading, Cell cell) {
  return weight_near(T_map_robot, position_sigma_m, yaw_sigma_rad, map, yaw(heading), cell);
}

struct LocalizationParams;
/// "discrete" (CMN, Robb), "particle" (CMN's baseline MCSE) or "scaled" (ours), by `params.filter`.
std::unique_ptr<Localizer> make_localizer(const CoarseMap& map, const LocalizationParams& params);

/// What such a localizer expects to see, for a planner that has only its belief; null where it
/// cannot tell.
std::unique_ptr<ExpectedLooks> make_expected_looks(const CoarseMap& map,
                                                   const LocalizationParams& params);

}  // namespace cmn
