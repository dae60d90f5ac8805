// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How far it is free around the robot, in directions that do not turn with it.
#pragma once

#include "coarse_map_nav/data/local_occupancy.hpp"

#include <array>
#include <vector>

namespace cmn {

/// Bearings of a profile: 10 deg apart, whole quarter turns of them map them onto each other.
constexpr int kBearings = 36;
constexpr int kBearingsPerQuarter = kBearings / 4;
constexpr double bearing_rad(int b) { return 2.0 * kPi * b / kBearings; }

struct Ray {
  double range_m = 0.0;  ///< free so far; 0: nothing known
  bool is_hit = false;   ///< and something stands there; false: nobody looked farther
  bool is_known() const { return range_m > 0.0; }
};
using RayProfile = std::array<Ray, kBearings>;

/// Casts rays through a local occupancy grid whose x axis has yaw `yaw_rad` in the frame of the
/// profile. A ray ends at the first cell seen to be occupied, at the first that was not seen, or at
/// `reach_m`. Whatever sensor filled the grid, the profile looks the same. The cells under the
/// robot itself need not have been seen, and tell nothing by themselves.
RayProfile cast_rays(const LocalOccupancy& seen, double yaw_rad, double reach_m);

}  // namespace cmn
