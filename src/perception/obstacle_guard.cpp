// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/obstacle_guard.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace cmn {

double occupied_share_ahead(const LocalOccupancy& seen, double side_m) {
  const double half = 0.5 * std::min(side_m / seen.resolution, static_cast<double>(seen.size));
  const auto cell_at = [&](double from_middle) {
    return static_cast<int>(std::lround(0.5 * seen.size + from_middle));
  };
  int cells = 0;
  int occupied = 0;
  for (int iy = cell_at(-half / 3.0); iy < cell_at(half / 3.0); ++iy) {
    for (int ix = cell_at(half / 3.0); ix < cell_at(half); ++ix) {
      ++cells;
      occupied += seen.occupancy[seen.index_of(ix, iy)] > 0.5F;
    }
  }
  return cells == 0 ? 0.0 : static_cast<double>(occupied) / cells;
}

bool sees_ahead(const RangeScan& scan) {
  constexpr double kAhead_rad = 15.0 * kPi / 180.0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double bearing = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    if (std::abs(wrap_angle(bearing + scan.T_robot_sensor.yaw)) < kAhead_rad &&
        !std::isnan(scan.ranges_m[i])) {
      return true;
    }
  }
  return false;
}

double free_way_m(const RangeScan& scan, double radius_m) {
  double way_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(range_m >= scan.range_min_m && range_m <= scan.range_max_m)) {
      continue;
    }
    const double bearing = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    const Point2 p = scan.T_robot_sensor * turned(Point2{range_m, 0.0}, bearing);
    if (p.x > 0.0 && std::abs(p.y) < radius_m) {
      way_m = std::min(way_m, p.x - std::sqrt(radius_m * radius_m - p.y * p.y));
    }
  }
  return std::max(0.0, way_m);
}

double clear_ahead_m(const RangeScan& scan, const LocalOccupancy& seen,
                     const ObstacleGuardParams& params) {
  if (params.type != "none" && scan.source == ObservationSource::kDepth && !sees_ahead(scan)) {
    return 0.0;
  }
  if (params.type == "footprint") {
    return free_way_m(scan, params.radius_m);
  }
  const bool is_blocked =
      params.type == "block" && occupied_share_ahead(seen, params.side_m) > params.occupied_share;
  return is_blocked ? 0.0 : std::numeric_limits<double>::infinity();
}

}  // namespace cmn
