// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/motion/velocity_profile.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cmn {
namespace {

const SpeedLimits kLimits{0.3, 0.5, 5.0};

/// The speeds of a base that does at once what it is told.
std::vector<double> drive(double way_m, double period_s) {
  std::vector<double> speeds{0.0};
  double left = way_m;
  while (std::abs(left) > 1e-3 && speeds.size() < 10000) {
    speeds.push_back(
        ramped(speeds.back(), approach_speed(left, kLimits), kLimits.acceleration, period_s));
    left -= speeds.back() * period_s;
  }
  return speeds;
}

TEST(VelocityProfile, GrowsWithTheWayLeftUpToTheTopSpeed) {
  double before = 0.0;
  for (double way = 0.0; way < 1.0; way += 0.001) {
    const double speed = approach_speed(way, kLimits);
    EXPECT_GE(speed, before);
    EXPECT_LE(speed, kLimits.max_speed);
    EXPECT_LE(speed * speed, 2.0 * kLimits.acceleration * way + 1e-12) << "cannot stop in " << way;
    before = speed;
  }
  EXPECT_DOUBLE_EQ(before, kLimits.max_speed);
  EXPECT_DOUBLE_EQ(approach_speed(0.0, kLimits), 0.0);
}

TEST(VelocityProfile, HasTheSignOfTheWayLeft) {
  EXPECT_DOUBLE_EQ(approach_speed(-0.02, kLimits), -approach_speed(0.02, kLimits));
}

TEST(VelocityProfile, IsContinuousWhereTheSquareRootTakesOver) {
  for (double way = 0.001; way < 0.2; way += 1e-4) {
    EXPECT_NEAR(approach_speed(way + 1e-7, kLimits), approach_speed(way, kLimits), 1e-6);
  }
}

TEST(VelocityProfile, IsATriangleForAShortWayAndATrapezoidForALongOne) {
  const std::vector<double> triangle = drive(0.1, 0.02);
  EXPECT_LT(*std::max_element(triangle.begin(), triangle.end()), kLimits.max_speed);
  const std::vector<double> trapezoid = drive(1.0, 0.02);
  EXPECT_GT(std::count(trapezoid.begin(), trapezoid.end(), kLimits.max_speed), 50);
}

TEST(VelocityProfile, NeverOvershootsAndNeverBrakesHarderThanTheLimitAtAnyRate) {
  for (const double period_s : {0.005, 0.02, 0.05, 0.1}) {
    for (const double way_m : {0.02, 0.05, 0.15, 0.43, 2.0}) {
      SCOPED_TRACE(std::to_string(period_s) + " s, " + std::to_string(way_m) + " m");
      double driven = 0.0;
      double before = 0.0;
      for (const double speed : drive(way_m, period_s)) {
        EXPECT_LE(std::abs(speed - before), kLimits.acceleration * period_s + 1e-12);
        driven += speed * period_s;
        before = speed;
      }
      EXPECT_NEAR(driven, way_m, 0.005);
    }
  }
}

TEST(VelocityProfile, ReachesAWantedSpeedOnlyAsFastAsTheLimitLetsIt) {
  EXPECT_DOUBLE_EQ(ramped(0.1, 0.3, 0.5, 0.02), 0.11);
  EXPECT_DOUBLE_EQ(ramped(0.1, -0.3, 0.5, 0.02), 0.09);
  EXPECT_DOUBLE_EQ(ramped(0.1, 0.105, 0.5, 0.02), 0.105);
  EXPECT_DOUBLE_EQ(ramped(0.1, 0.3, 0.5, 0.0), 0.1);
}

}  // namespace
}  // namespace cmn
