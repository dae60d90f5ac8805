// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/odometry_noise.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <cmath>
#include <random>

namespace cmn {
namespace {

constexpr double kRadPerDeg = kPi / 180.0;
constexpr double kStill_m = 1e-4;  // a shorter way has no direction worth turning to

/// The turn a step begins with: towards its direction, or away from it when driving backwards.
double first_turn(const Pose2& step) {
  const double way = norm(step.position());
  if (way < kStill_m) {
    return 0.0;
  }
  const double bearing = std::atan2(step.y, step.x);
  return std::abs(bearing) <= kPi / 2.0 ? bearing : wrap_angle(bearing + kPi);
}

}  // namespace

std::vector<Pose2> drifting_odometry(const std::vector<Pose2>& path,
                                     const OdometryNoiseParams& params, std::uint32_t seed) {
  std::mt19937_64 rng{seed};
  const double way_factor = 1.0 + params.wheel_bias * draw_normal(rng);
  const double turn_factor = 1.0 + params.wheelbase_bias * draw_normal(rng);
  const auto noisy_turn = [&](double turn_rad, double way_m) {
    const double quarters = std::abs(turn_rad) / (kPi / 2.0);
    const double variance_deg2 = params.turn_deg * params.turn_deg * quarters +
                                 params.swerve_deg * params.swerve_deg * way_m;
    return turn_factor * turn_rad + kRadPerDeg * std::sqrt(variance_deg2) * draw_normal(rng);
  };

  std::vector<Pose2> odometry;
  odometry.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i == 0) {
      odometry.push_back({0.0, 0.0, residual_yaw(path[0])});
      continue;
    }
    const Pose2 step = inverse(path[i - 1]) * path[i];
    const double way_m = norm(step.position());
    const double turn_1 = first_turn(step);
    const double turn_2 = wrap_angle(step.yaw - turn_1);
    const double signed_way = std::cos(turn_1) * step.x + std::sin(turn_1) * step.y;
    const double way =
        way_factor * signed_way + params.slip_m * std::sqrt(way_m) * draw_normal(rng);
    // The swerve of the way is shared out between the turns before and after it.
    const Pose2 turned_1{0.0, 0.0, noisy_turn(turn_1, way_m / 2.0)};
    const Pose2 driven{way, 0.0, noisy_turn(turn_2, way_m / 2.0)};
    odometry.push_back(odometry.back() * turned_1 * driven);
  }
  return odometry;
}

}  // namespace cmn
