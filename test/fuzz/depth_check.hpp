// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What must hold of whatever a depth camera sends.
#pragma once

#include "coarse_map_nav/perception/depth_projection.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

#include <cmath>

#include "fuzz_input.hpp"

namespace cmn {

/// Numbers of a mount: any that are no NaN.
inline Eigen::Isometry3d take_mount(FuzzInput& input) {
  const double pitch = input.take<std::int8_t>() / 40.0;
  const double height_m = input.take<std::int8_t>() / 50.0;
  Eigen::Matrix3d ahead;
  ahead << 0, 0, 1, -1, 0, 0, 0, -1, 0;  // an optical frame that looks ahead
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.linear() = Eigen::AngleAxisd{pitch, Eigen::Vector3d::UnitY()} * ahead;
  mount.translation() = Eigen::Vector3d{0.1, 0.0, height_m};
  return mount;
}

/// Few bearings, for speed: they are all alike.
inline DepthParams coarse_bearings() {
  DepthParams params;
  params.increment_deg = 3.0;
  return params;
}

/// The scan and the occupancy made of it hold numbers, within their bounds.
inline void check(const RangeScan& scan) {
  require(scan.sights.size() == scan.ranges_m.size(), "each beam has a sight");
  for (const float range_m : scan.ranges_m) {
    require(!(range_m < 0.0F) && !(std::isfinite(range_m) && range_m > 6.0F), "ranges are ranges");
  }
  for (const RangeScan::Sight& sight : scan.sights) {
    require(sight.from_m >= 0.0F && sight.to_m >= sight.from_m && sight.to_m < 6.0F, "sights");
  }
  static RangeProjector projector{ProjectionParams{64, 8.0, 0.0}};  // keeps its table
  const LocalOccupancy seen = projector.project(scan);
  for (std::size_t i = 0; i < seen.cell_count(); ++i) {
    require(seen.occupancy[i] >= 0.0F && seen.occupancy[i] <= 1.0F, "occupancy is in [0, 1]");
    require(seen.confidence[i] >= 0.0F && seen.confidence[i] <= 1.0F, "confidence is in [0, 1]");
  }
}

}  // namespace cmn
