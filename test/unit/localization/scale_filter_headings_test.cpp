// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The whole-range filter with more headings than four: drawings that lie askew.
#include "coarse_map_nav/localization/scale_filter.hpp"
#include "coarse_map_nav/mapping/downsample.hpp"
#include "coarse_map_nav/mapping/turned_map.hpp"

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "wanderer.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kConverged = 0.8;
constexpr double kRadPerDeg = kPi / 180.0;

ScaleFilterParams with_headings(int headings) {
  ScaleFilterParams params;
  params.headings = headings;
  params.scales = 1;
  return params;
}

/// The flat on cells of 0.25 m that lie askew in the map frame.
CoarseMap askew_flat(double turn_rad) {
  const CoarseMap built = flat();
  Grid<std::uint8_t> fine{built.width() * 10, built.height() * 10};
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const Cell c = fine.cell_at(i);
    fine[i] = built.occupied()({c.x / 10, c.y / 10});
  }
  return downsampled(turned_map({std::move(fine), kFlatCell_m / 10.0}, turn_rad), 0.25);
}

TEST(ScaleFilterHeadings, AreEvenlySpacedAboutTheWalls) {
  for (const int headings : {4, 8, 12, 20, 36}) {
    SCOPED_TRACE(std::to_string(headings) + " headings");
    const ScaleFilter filter{flat(), with_headings(headings), kConverged};
    const int turns = headings / 4;
    ASSERT_EQ(filter.turn_marginal().size(), static_cast<std::size_t>(turns));
    bool has_none = false;
    for (int j = 0; j < turns; ++j) {
      EXPECT_GT(filter.turn_of(j), -kPi / 4.0 + 1e-9);
      EXPECT_LE(filter.turn_of(j), kPi / 4.0 + 1e-9);
      EXPECT_NEAR(filter.turn_of(j), filter.turn_of(0) + j * 2.0 * kPi / headings, 1e-12);
      EXPECT_NEAR(filter.turn_marginal()[static_cast<std::size_t>(j)], 1.0 / turns, 1e-5);
      has_none |= filter.turn_of(j) == 0.0;
    }
    EXPECT_TRUE(has_none);
    EXPECT_EQ(filter.scale_marginal().size(), 1U);
  }
}

TEST(ScaleFilterHeadings, FindADrawingThatLiesAskew) {
  for (const int headings : {36, 52}) {
    for (const double turn_deg : {7.0, -18.0}) {
      SCOPED_TRACE(std::to_string(headings) + " headings, " + std::to_string(turn_deg) + " deg");
      const CoarseMap drawing = askew_flat(turn_deg * kRadPerDeg);
      int found = 0;
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        ScaleFilter filter{drawing, with_headings(headings), kConverged};
        Wanderer robot{seed};
        for (int i = 0; i < 50; ++i) {
          robot.step_and_look(filter);
        }
        const Localization at = filter.localization();
        const Pose2 T_map_robot = pose_in_map(drawing, at);
        const double off_rad = wrap_angle(T_map_robot.yaw - robot.T_world_robot.yaw);
        found += at.is_converged &&
                 norm(T_map_robot.position() - robot.T_world_robot.position()) < 0.5 &&
                 std::abs(off_rad) < 2.0 * kPi / headings;
        EXPECT_EQ(at.estimate.heading, nearest_heading(at.yaw_rad));
      }
      EXPECT_GE(found, 4);  // N = 4: 4
    }
  }
}

TEST(ScaleFilterHeadings, StartAtAGivenPoseWhateverTheOdometrySays) {
  const CoarseMap drawing = askew_flat(20.0 * kRadPerDeg);
  for (const double odometry_deg : {0.0, 40.0, 170.0, -100.0}) {
    SCOPED_TRACE(std::to_string(odometry_deg) + " deg");
    ScaleFilter filter{drawing, with_headings(36), kConverged};
    const Pose2 T_map_robot{1.25, 0.75, -kPi / 2.0};
    ASSERT_TRUE(filter.reset_near(T_map_robot, 0.3, 0.1));
    EXPECT_NEAR(wrap_angle(pose_in_map(drawing, filter.localization()).yaw - T_map_robot.yaw), 0.0,
                3.0 * kRadPerDeg);
    // What it sees says nothing, and it turns left by 30 deg.
    const Pose2 T_odom_robot{3.0, -1.0, odometry_deg * kRadPerDeg};
    filter.update(LocalOccupancy{64, 0.2}, T_odom_robot);
    EXPECT_NEAR(wrap_angle(pose_in_map(drawing, filter.localization()).yaw - T_map_robot.yaw), 0.0,
                8.0 * kRadPerDeg);
    filter.update(LocalOccupancy{64, 0.2}, T_odom_robot * Pose2{0.0, 0.0, 30.0 * kRadPerDeg});
    const Pose2 at = pose_in_map(drawing, filter.localization());
    EXPECT_NEAR(wrap_angle(at.yaw - T_map_robot.yaw), 30.0 * kRadPerDeg, 8.0 * kRadPerDeg);
    EXPECT_LT(norm(at.position() - T_map_robot.position()), 0.2);
    EXPECT_GT(filter.localization().confidence, 0.9);
  }
}

TEST(ScaleFilterHeadings, AGivenHeadingLeavesTheTurnOpen) {
  ScaleFilter filter{flat(), with_headings(12), kConverged};
  filter.reset_heading(Heading::kWest);
  double mass = 0.0;
  for (const double p : filter.localization().belief.layer(Heading::kWest)) {
    mass += p;
  }
  EXPECT_NEAR(mass, 1.0, 1e-5);
  for (const double p : filter.turn_marginal()) {
    EXPECT_NEAR(p, 1.0 / 3.0, 1e-5);
  }
}

}  // namespace
}  // namespace cmn
