// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/wall_compass.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cmn {
namespace {

constexpr double kDegree = kPi / 180.0;
/// Sought to either side, a degree at a time [deg]; the walls' own quarter turns are 90 apart.
constexpr int kNarrowest = 10;
constexpr int kWidest = 30;
/// Half of what is sought, in standard deviations of what is expected.
constexpr double kSigmas = 3.0;
constexpr std::size_t kFewestHits = 60;

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

void WallCompass::look(const LocalOccupancy& seen, double yaw_rad) {
  if (!params_.enabled) {
    return;
  }
  const double turn_deg = wrap_angle(yaw_rad - last_yaw_rad_.value_or(yaw_rad)) / kDegree;
  last_yaw_rad_ = yaw_rad;
  const double lost = params_.turn_share * turn_deg / params_.look_sigma_deg;
  variance_ += lost * lost;
  // The near side of what is occupied: cells beside one that was seen to be free.
  std::vector<Point2> hits;
  const auto is_free = [&](int ix, int iy) {
    const std::size_t i = seen.index_of(ix, iy);
    return seen.confidence[i] > 0.0F && seen.occupancy[i] <= 0.5F;
  };
  for (int iy = 1; iy + 1 < seen.size; ++iy) {
    for (int ix = 1; ix + 1 < seen.size; ++ix) {
      const std::size_t i = seen.index_of(ix, iy);
      if (seen.confidence[i] > 0.0F && seen.occupancy[i] > 0.5F &&
          (is_free(ix - 1, iy) || is_free(ix + 1, iy) || is_free(ix, iy - 1) ||
           is_free(ix, iy + 1))) {
        hits.push_back({(ix + 0.5 - 0.5 * seen.size) * seen.resolution,
                        (iy + 0.5 - 0.5 * seen.size) * seen.resolution});
      }
    }
  }
  if (hits.size() < kFewestHits) {
    return;
  }
  const auto half = static_cast<std::size_t>(std::ceil(0.75 * seen.side_m() / params_.bin_m)) + 2;
  counts_.resize(4 * half);
  // In the grid's frame the axes are now expected at this yaw, up to quarter turns.
  const double expected_rad = std::remainder(axes_yaw_rad_ - yaw_rad, kPi / 2.0);
  const int reach =
      std::clamp(static_cast<int>(kSigmas * params_.look_sigma_deg * std::sqrt(variance_)),
                 kNarrowest, kWidest);
  std::vector<double> sharp(static_cast<std::size_t>(2 * reach + 1));
  double mean = 0.0;
  std::size_t best = 0;
  for (std::size_t i = 0; i < sharp.size(); ++i) {
    sharp[i] = sharpness(hits, expected_rad + (static_cast<double>(i) - reach) * kDegree);
    mean += sharp[i] / static_cast<double>(sharp.size());
    best = sharp[i] > sharp[best] ? i : best;
  }
  const bool is_at_the_rim = best == 0 || best + 1 == sharp.size();
  if (is_at_the_rim || sharp[best] < params_.least_peak * mean) {
    return;
  }
  // The top of the parabola through the three sharpest neighbours.
  const double before = sharp[best - 1];
  const double after = sharp[best + 1];
  const double bend = before - 2.0 * sharp[best] + after;
  const double shift = bend < 0.0 ? 0.5 * (before - after) / bend : 0.0;
  const double off_deg = static_cast<double>(best) - reach + shift;
  // The walk from look to look with which the gain settles at params_.gain.
  const double walk = params_.gain * params_.gain / std::max(1e-9, 1.0 - params_.gain);
  const double gain = (variance_ + walk) / (variance_ + walk + 1.0);
  axes_yaw_rad_ += gain * off_deg * kDegree;
  variance_ = gain;
}

}  // namespace cmn
