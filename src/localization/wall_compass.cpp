// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/wall_compass.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cmn {
namespace {

constexpr double kDegree = kPi / 180.0;  ///< also the step of the search
constexpr double kWidest_deg = 10.0;     ///< of it, at least, to either side
constexpr std::size_t kFewestHits = 60;
constexpr double kNeverSurer_deg = 0.2;

double squared(double value) { return value * value; }

}  // namespace

double WallCompass::sharpness(const std::vector<Point2>& hits, double yaw_rad) {
  const double c = std::cos(yaw_rad) / params_.bin_m;
  const double s = std::sin(yaw_rad) / params_.bin_m;
  const auto half = static_cast<int>(counts_.size() / 4);
  std::fill(counts_.begin(), counts_.end(), 0);
  for (const Point2& p : hits) {
    const int x = static_cast<int>(std::floor(c * p.x + s * p.y));
    const int y = static_cast<int>(std::floor(c * p.y - s * p.x));
    ++counts_[static_cast<std::size_t>(x + half)];
    ++counts_[static_cast<std::size_t>(y + 3 * half)];
  }
  double sum = 0.0;
  for (const int count : counts_) {
    sum += static_cast<double>(count) * count;
  }
  return sum;
}

void WallCompass::lose() { sigma_deg_ = std::max(sigma_deg_, params_.lost_sigma_deg); }

void WallCompass::look(const LocalOccupancy& seen, const Pose2& T_odom_robot) {
  if (!params_.enabled) {
    return;
  }
  if (seen.heading_drift && drift_last_ && seen.heading_drift->since_s == drift_last_->since_s) {
    axes_yaw_rad_ += wrap_angle(seen.heading_drift->rad - drift_last_->rad);
    sigma_deg_ = std::hypot(sigma_deg_, params_.drift_aligned_deg);
  } else if (T_odom_last_) {
    const double turned_rad = std::abs(wrap_angle(T_odom_robot.yaw - T_odom_last_->yaw));
    const double driven_m = norm(T_odom_robot.position() - T_odom_last_->position());
    sigma_deg_ = std::sqrt(
        squared(sigma_deg_) + squared(params_.drift_per_turn_deg) * turned_rad / (kPi / 2.0) +
        squared(params_.drift_per_m_deg) * driven_m + squared(params_.drift_per_look_deg));
  }
  T_odom_last_ = T_odom_robot;
  drift_last_ = seen.heading_drift;
  const std::vector<Point2> hits = surface_of(seen);
  if (hits.size() < kFewestHits) {
    return;
  }
  const auto half = static_cast<std::size_t>(std::ceil(0.75 * seen.side_m() / params_.bin_m)) + 2;
  counts_.resize(4 * half);
  // In the grid's frame the axes are now expected at this yaw, up to quarter turns.
  const double expected_rad = std::remainder(axes_yaw_rad_ - T_odom_robot.yaw, kPi / 2.0);
  // Of peaks that odometry rules out nothing is believed: not all that stands about is a wall.
  const double gate_deg = std::min(45.0, 3.0 * sigma_deg_ + 1.0);
  const int steps = static_cast<int>(std::ceil(std::max(gate_deg, kWidest_deg))) + 1;
  std::vector<double> sharp;
  double mean = 0.0;
  for (int i = -steps; i <= steps; ++i) {
    sharp.push_back(sharpness(hits, expected_rad + i * kDegree));
    mean += sharp.back() / (2 * steps + 1);
  }
  const int reach = static_cast<int>(std::lround(gate_deg));
  const auto at = [&](int i) { return sharp[static_cast<std::size_t>(i + steps)]; };
  int best = 0;
  for (int i = -reach; i <= reach; ++i) {
    best = at(i) > at(best) ? i : best;
  }
  if (at(best) < params_.least_peak * mean || at(best) < at(best - 1) || at(best) < at(best + 1)) {
    return;
  }
  // The top of the parabola through the three sharpest neighbours.
  const double bend = at(best - 1) - 2.0 * at(best) + at(best + 1);
  const double shift = bend < 0.0 ? 0.5 * (at(best - 1) - at(best + 1)) / bend : 0.0;
  // The sharper, the surer: in the clutter of a hall there are peaks as well, but flat ones.
  const double look_sigma_deg =
      params_.look_sigma_deg * (params_.least_peak - 1.0) / (at(best) / mean - 1.0);
  const double gain = squared(sigma_deg_) / (squared(sigma_deg_) + squared(look_sigma_deg));
  axes_yaw_rad_ += gain * (best + shift) * kDegree;
  sigma_deg_ = std::max(kNeverSurer_deg, std::sqrt(1.0 - gain) * sigma_deg_);
}

}  // namespace cmn
