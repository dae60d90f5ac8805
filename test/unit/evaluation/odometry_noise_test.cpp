// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/odometry_noise.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kDegPerRad = 180.0 / kPi;
constexpr OdometryNoiseParams kNone{0.0, 0.0, 0.0, 0.0, 0.0};

std::vector<Pose2> straight(double length_m, int steps) {
  std::vector<Pose2> path;
  for (int i = 0; i <= steps; ++i) {
    path.push_back({length_m * i / steps, 0.0, 0.0});
  }
  return path;
}

std::vector<Pose2> pivot(double angle_rad, int steps) {
  std::vector<Pose2> path;
  for (int i = 0; i <= steps; ++i) {
    path.push_back({0.0, 0.0, wrap_angle(angle_rad * i / steps)});
  }
  return path;
}

/// Standard deviation of what `of` says about the last pose, over many seeds.
template <class Of>
double spread(const std::vector<Pose2>& path, const OdometryNoiseParams& params, Of&& of) {
  constexpr int kRuns = 2000;
  double sum = 0.0;
  double squares = 0.0;
  for (std::uint32_t seed = 0; seed < kRuns; ++seed) {
    const double value = of(drifting_odometry(path, params, seed).back());
    sum += value;
    squares += value * value;
  }
  return std::sqrt(squares / kRuns - sum / kRuns * (sum / kRuns));
}
double x_of(const Pose2& pose) { return pose.x; }
double yaw_deg_of(const Pose2& pose) { return pose.yaw * kDegPerRad; }

TEST(OdometryNoise, WithoutNoiseIsThePathFromItsStart) {
  const std::vector<Pose2> path{
      {3.0, 4.0, 1.7}, {3.0, 4.5, 1.9}, {2.9, 4.4, -2.0}, {2.9, 4.4, 3.1}};
  const auto odometry = drifting_odometry(path, kNone, 1);
  ASSERT_EQ(odometry.size(), path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Pose2 driven = inverse(path[0]) * path[i];
    const Pose2 said = inverse(odometry[0]) * odometry[i];
    EXPECT_NEAR(said.x, driven.x, 1e-12) << i;
    EXPECT_NEAR(said.y, driven.y, 1e-12) << i;
    EXPECT_NEAR(wrap_angle(said.yaw - driven.yaw), 0.0, 1e-12) << i;
  }
}

TEST(OdometryNoise, StartsWithAxesAlongThoseOfThePathsFrame) {
  for (int degree = -180; degree <= 180; degree += 7) {
    const double yaw = degree / kDegPerRad;
    const Pose2 first = drifting_odometry({{5.0, 6.0, yaw}}, {}, 1).front();
    EXPECT_EQ(first.x, 0.0);
    EXPECT_EQ(first.y, 0.0);
    EXPECT_LE(std::abs(first.yaw), kPi / 4.0 + 1e-12);
    const double quarters = (yaw - first.yaw) / (kPi / 2.0);
    EXPECT_NEAR(quarters, std::round(quarters), 1e-9) << degree;
  }
}

TEST(OdometryNoise, HasTheSpreadItsParametersSayHoweverFinelySampled) {
  // 2000 runs: the standard error of a spread is 1.6 %; 6 % is beyond 3 sigma.
  for (const int steps : {1, 10, 90}) {
    SCOPED_TRACE(steps);
    OdometryNoiseParams slip = kNone;
    slip.slip_m = 0.02;
    EXPECT_NEAR(spread(straight(1.0, steps), slip, x_of), 0.02, 0.0012);
    EXPECT_NEAR(spread(straight(9.0, steps), slip, x_of), 0.06, 0.0036);
    OdometryNoiseParams turn = kNone;
    turn.turn_deg = 1.0;
    EXPECT_NEAR(spread(pivot(kPi / 2.0, steps), turn, yaw_deg_of), 1.0, 0.06);
    EXPECT_EQ(spread(straight(5.0, steps), turn, yaw_deg_of), 0.0);
    OdometryNoiseParams swerve = kNone;
    swerve.swerve_deg = 0.5;
    EXPECT_NEAR(spread(straight(4.0, steps), swerve, yaw_deg_of), 1.0, 0.06);
  }
}

TEST(OdometryNoise, BiasIsOneFactorForAWholeRun) {
  OdometryNoiseParams bias = kNone;
  bias.wheel_bias = 0.01;
  EXPECT_NEAR(spread(straight(10.0, 100), bias, x_of), 0.1, 0.006);
  const auto odometry = drifting_odometry(straight(10.0, 100), bias, 5);
  EXPECT_NEAR(odometry[50].x / 5.0, odometry[100].x / 10.0, 1e-12);
  bias = kNone;
  bias.wheelbase_bias = 0.01;
  EXPECT_NEAR(spread(pivot(kPi / 2.0, 10), bias, yaw_deg_of), 0.9, 0.054);
}

TEST(OdometryNoise, OfDrivingBackwardsIsThatOfDrivingForwards) {
  OdometryNoiseParams turn = kNone;
  turn.turn_deg = 5.0;
  EXPECT_EQ(spread(straight(-3.0, 10), turn, yaw_deg_of), 0.0) << "there is no turn in it";
  OdometryNoiseParams slip = kNone;
  slip.slip_m = 0.02;
  EXPECT_NEAR(spread(straight(-1.0, 10), slip, x_of), 0.02, 0.0012);
}

TEST(OdometryNoise, IsTheSameForTheSameSeed) {
  const auto path = straight(2.0, 20);
  const auto a = drifting_odometry(path, {}, 3);
  const auto b = drifting_odometry(path, {}, 3);
  const auto c = drifting_odometry(path, {}, 4);
  EXPECT_EQ(a.back().x, b.back().x);
  EXPECT_NE(a.back().x, c.back().x);
}

}  // namespace
}  // namespace cmn
