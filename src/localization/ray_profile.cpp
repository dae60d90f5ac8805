// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/ray_profile.hpp"

#include <algorithm>
#include <cmath>

namespace cmn {
namespace {

/// Under the robot itself; a camera that looks ahead does not see all of it.
constexpr double kOwnGround_m = 0.2;

}  // namespace

RayProfile cast_rays(const LocalOccupancy& seen, double yaw_rad, double reach_m) {
  RayProfile profile;
  const double step = 0.5 * seen.resolution;
  // The robot stands on the cells that meet in the middle. Cameras that see less than a quarter
  // leave all four of them out, at any heading, and with them the way to what they do see.
  const double under_robot = std::max(kOwnGround_m, 1.5 * seen.resolution);
  const double reach = std::min(reach_m, 0.5 * seen.side_m() - seen.resolution);
  for (int b = 0; b < kBearings; ++b) {
    const Point2 ahead = turned(Point2{1.0, 0.0}, bearing_rad(b) - yaw_rad);
    Ray& ray = profile[static_cast<std::size_t>(b)];
    for (double range = step; range <= reach; range += step) {
      const int ix =
          static_cast<int>(std::floor(range * ahead.x / seen.resolution + 0.5 * seen.size));
      const int iy =
          static_cast<int>(std::floor(range * ahead.y / seen.resolution + 0.5 * seen.size));
      const std::size_t i = seen.index_of(ix, iy);
      if (seen.confidence[i] <= 0.0F) {
        if (range <= under_robot) {
          continue;
        }
        break;
      }
      ray.range_m = range;
      if (seen.occupancy[i] > 0.5F) {
        ray.is_hit = true;
        break;
      }
    }
    if (!ray.is_hit && ray.range_m <= under_robot) {
      ray.range_m = 0.0;
    }
  }
  return profile;
}

}  // namespace cmn
