// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/data/look_contradiction.hpp"

#include "coarse_map_nav/data/whole_number.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace cmn {
namespace {

constexpr double kMargin_m = 0.3;
constexpr double kReach_m = 5.0;  ///< farther away, a small error of the turn is a large one
constexpr int kFewest = 15;       ///< surfaces of a look to judge by
/// What odometry may have missed of a turn.
constexpr std::array<double, 5> kTurns_rad{0.0, -0.05, 0.05, -0.1, 0.1};
constexpr double kNothing = 0.05;

/// Of the surfaces of one look, in its frame, that lie where the `other` saw something.
double contradicted_share(const std::vector<Point2>& surface, const LocalOccupancy& other,
                          const Pose2& T_other_look) {
  int compared = 0;
  int contradicted = 0;
  const int margin = static_cast<int>(std::ceil(kMargin_m / other.resolution));
  for (const Point2 p_look : surface) {
    if (norm(p_look) > kReach_m) {
      continue;
    }
    const Point2 p = T_other_look * p_look;
    const int x = whole_below(p.x / other.resolution + 0.5 * other.size);
    const int y = whole_below(p.y / other.resolution + 0.5 * other.size);
    if (x < margin || y < margin || x + margin >= other.size || y + margin >= other.size ||
        other.confidence[other.index_of(x, y)] <= 0.0F) {
      continue;
    }
    bool is_amid_free = true;
    for (int dy = -margin; dy <= margin && is_amid_free; ++dy) {
      for (int dx = -margin; dx <= margin && is_amid_free; ++dx) {
        const std::size_t i = other.index_of(x + dx, y + dy);
        is_amid_free = other.confidence[i] > 0.0F && other.occupancy[i] < 0.5F;
      }
    }
    ++compared;
    contradicted += is_amid_free;
  }
  return compared < kFewest ? 0.0 : static_cast<double>(contradicted) / compared;
}

}  // namespace

double contradiction(const LocalOccupancy& before, const LocalOccupancy& now,
                     const Pose2& T_before_now) {
  if (before.size == 0 || now.size == 0) {
    return 0.0;
  }
  const std::vector<Point2> surface_before = surface_of(before);
  const std::vector<Point2> surface_now = surface_of(now);
  double least = 1.0;
  for (const double turn_rad : kTurns_rad) {
    const Pose2 T_turned{T_before_now.x, T_before_now.y, T_before_now.yaw + turn_rad};
    least = std::min({least, contradicted_share(surface_now, before, T_turned),
                      contradicted_share(surface_before, now, inverse(T_turned))});
    if (least < kNothing) {
      break;  // as nearly always, by what odometry says
    }
  }
  return least;
}

double LookComparison::next(const LocalOccupancy& look, const Pose2& T_odom_robot) {
  const double contradicted = contradiction(last_, look, inverse(T_odom_last_) * T_odom_robot);
  last_ = look;
  T_odom_last_ = T_odom_robot;
  return contradicted;
}

}  // namespace cmn
