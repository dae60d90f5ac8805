// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Does the base stand still?
#pragma once

#include "coarse_map_nav/data/odometry.hpp"

#include <optional>

namespace cmn {

/// Says that the base rests once odometry has stayed within 1 mm and 0.1 deg for 0.1 s.
///
/// A window of time rather than the speed between two samples: it means the same at every rate of
/// the odometry, and one sample that is repeated does not count as rest.
class RestDetector {
 public:
  static constexpr double kWindow_s = 0.1;

  void update(const OdometrySample& now);
  void reset() { anchor_.reset(); }
  bool at_rest() const { return anchor_ && newest_s_ - anchor_->stamp_s >= kWindow_s; }

 private:
  std::optional<OdometrySample> anchor_;  ///< since when, and where, nothing has moved
  double newest_s_ = 0.0;
};

}  // namespace cmn
