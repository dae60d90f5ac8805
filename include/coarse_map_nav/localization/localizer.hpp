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
  /// Starts over anywhere on the drawing, at a known heading (CMN).
  virtual void reset_heading(Heading heading) = 0;
  /// Good until the next call of update().
  virtual Localization localization() const = 0;
};

struct LocalizationParams;
/// "discrete" (CMN, Robb) or "particle" (CMN's baseline MCSE), by `params.filter`.
std::unique_ptr<Localizer> make_localizer(const CoarseMap& map, const LocalizationParams& params);

}  // namespace cmn
