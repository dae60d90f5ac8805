// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/predicted_scan.hpp"

#include "coarse_map_nav/data/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace cmn {
namespace {

constexpr std::size_t kBeams = 360;
constexpr double kStep_m = 0.01;  ///< along a ray: the near square's cells
/// Within the robot's own radius the ground is free; what is not free there is out of view.
constexpr double kNearest_m = 0.15;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// P(free and in sight) at a place of a square; negative outside.
float free_at(const LocalOccupancy& square, Point2 p) {
  const double half = 0.5 * square.size;
  const double x = p.x / square.resolution + half;
  const double y = p.y / square.resolution + half;
  if (!(x >= 0.0 && y >= 0.0 && x < square.size && y < square.size)) {
    return -1.0F;
  }
  const std::size_t i = square.index_of(static_cast<int>(x), static_cast<int>(y));
  return square.confidence[i] * (1.0F - square.occupancy[i]);
}

float free_at(const PredictedOccupancy& predicted, Point2 p) {
  const float near = free_at(predicted.near, p);
  return near < 0.0F && predicted.wide ? free_at(*predicted.wide, p) : near;
}

/// Where along a ray the obstacle begins with at least 10, 50 and 90 %; the border of what is
/// predicted where it never does.
struct Ranges {
  double tenth_m = 0.0;
  double median_m = 0.0;
  double most_m = 0.0;
  bool is_met = false;  ///< before the border, with 90 %
};

Ranges ranges_along(const PredictedOccupancy& predicted, Point2 direction) {
  Ranges ranges;
  double r = kNearest_m;
  for (;; r += kStep_m) {
    const float p_free = free_at(predicted, r * direction);
    if (p_free < 0.0F) {
      break;
    }
    if (p_free >= 0.9F) {  // seen through after all: what was before is no obstacle
      ranges.tenth_m = r;
    }
    if (p_free >= 0.5F) {
      ranges.median_m = r;
    }
    if (p_free < 0.1F) {
      ranges.is_met = true;
      break;
    }
  }
  ranges.most_m = r;
  return ranges;
}

}  // namespace

RangeScan predicted_scan(const PredictedOccupancy& predicted, const ColorPanorama& panorama,
                         const RgbParams& params) {
  RangeScan scan;
  scan.stamp_s = predicted.near.stamp_s;
  scan.source = ObservationSource::kRgb;
  scan.angle_min_rad = -kPi;
  scan.angle_increment_rad = 2.0 * kPi / kBeams;
  const double side_m = predicted.wide ? predicted.wide->side_m() : predicted.near.side_m();
  scan.range_max_m = side_m;  // farther than the squares' corners
  for (std::size_t i = 0; i < kBeams; ++i) {
    const double bearing_rad =
        scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    const Ranges ranges = ranges_along(predicted, {std::cos(bearing_rad), std::sin(bearing_rad)});
    const bool is_known = ranges.median_m >= kNearest_m && is_in_view(panorama, bearing_rad);
    const bool is_hit = ranges.is_met && ranges.most_m - ranges.tenth_m <= params.most_spread_m;
    const double free_m = std::max(ranges.tenth_m, kNearest_m);
    scan.ranges_m.push_back(!is_known ? kNaN
                            : is_hit  ? static_cast<float>(ranges.median_m)
                                      : kInfinity);
    scan.sights.push_back({0.0F, static_cast<float>(free_m)});
  }
  return scan;
}

}  // namespace cmn
