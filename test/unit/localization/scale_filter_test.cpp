// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/scale_filter.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "random_case.hpp"
#include "wanderer.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kConverged = 0.8;

void expect_distribution(const ScaleFilter& filter) {
  const Belief& belief = filter.localization().belief;
  double sum = 0.0;
  for (const Heading h : kHeadings) {
    for (const double p : belief.layer(h)) {
      ASSERT_GE(p, 0.0);  // nor NaN
      sum += p;
    }
  }
  ASSERT_NEAR(sum, 1.0, 1e-5);
  ASSERT_NEAR(total(belief), 1.0, 1e-5);  // nothing in the padding
  double scales = 0.0;
  for (const double p : filter.scale_marginal()) {
    ASSERT_GE(p, 0.0);
    scales += p;
  }
  ASSERT_NEAR(scales, 1.0, 1e-5);
  const Localization at = filter.localization();
  ASSERT_GE(at.confidence, 0.0);
  ASSERT_LE(at.confidence, 1.0 + 1e-5);
  ASSERT_TRUE(std::isfinite(at.position_cells.x) && std::isfinite(at.position_cells.y));
  ASSERT_TRUE(std::isfinite(at.scale));
}

double mass_of(const Belief& belief, Heading heading) {
  const std::vector<double>& layer = belief.layer(heading);
  double sum = 0.0;
  for (const double p : layer) {
    sum += belief.factor() * p;
  }
  return sum;
}

int best_sheet(const ScaleFilter& filter) {
  const std::vector<double> p = filter.scale_marginal();
  return static_cast<int>(std::max_element(p.begin(), p.end()) - p.begin());
}

int nearest_sheet(const ScaleFilter& filter, double scale) {
  int best = 0;
  for (int i = 0; i < static_cast<int>(filter.scale_marginal().size()); ++i) {
    if (std::abs(std::log(filter.scale_of(i) / scale)) <
        std::abs(std::log(filter.scale_of(best) / scale))) {
      best = i;
    }
  }
  return best;
}

TEST(ScaleFilter, BeginsAnywhereAtAnyHeading) {
  const ScaleFilter filter{flat(), ScaleFilterParams{}, kConverged};
  expect_distribution(filter);
  for (const Heading h : kHeadings) {
    EXPECT_NEAR(mass_of(filter.localization().belief, h), 0.25, 1e-5);
  }
  EXPECT_FALSE(filter.localization().is_converged);
  // The nominal scale is the most probable, those farthest from it the least.
  const std::vector<double> scales = filter.scale_marginal();
  EXPECT_EQ(best_sheet(filter), nearest_sheet(filter, 1.0));
  EXPECT_LT(scales.front(), scales[1]);
  EXPECT_LT(scales.back(), scales[3]);
}

TEST(ScaleFilter, FindsItself) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    ScaleFilter filter{flat(), ScaleFilterParams{}, kConverged};
    Wanderer robot{seed};
    for (int i = 0; i < 40; ++i) {
      robot.step_and_look(filter);
    }
    found += robot.is_found_by(filter);
  }
  EXPECT_GE(found, 8);  // N = 8: 8
}

TEST(ScaleFilter, LearnsThatTheDrawingHasTheScaleWrong) {
  for (const double scale : {0.8, 1.25}) {
    SCOPED_TRACE("scale " + std::to_string(scale));
    int found = 0;
    int near = 0;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      ScaleFilter filter{flat(scale * kFlatCell_m), ScaleFilterParams{}, kConverged};
      Wanderer robot{seed};
      for (int i = 0; i < 50; ++i) {
        robot.step_and_look(filter);
      }
      found += robot.is_found_by(filter);
      // Ranges that are too short are cheap: rather the next smaller sheet than the next greater.
      const int off = best_sheet(filter) - nearest_sheet(filter, scale);
      near += off == 0 || off == -1;
    }
    EXPECT_GE(found, 4);  // N = 4: 4
    EXPECT_GE(near, 4);   // N = 4: 4
  }
}

/// How often, of eight times, a robot that is sure of its place is sure of the right one again
/// after it was put elsewhere and has walked on for `steps`; it was told by a belief that
/// re-opened.
int times_found_again(const ScaleFilterParams& params, int steps) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    ScaleFilter filter{flat(), params, kConverged};
    Wanderer robot{seed};
    filter.reset_near(robot.T_world_robot, 0.3, 0.1);
    filter.update(robot.look(), robot.T_odom_robot);
    for (int i = 0; i < 10; ++i) {
      robot.step_and_look(filter);
    }
    EXPECT_TRUE(robot.is_found_by(filter)) << seed;
    robot.be_put_elsewhere();
    bool has_reopened = false;
    for (int i = 0; i < steps; ++i) {
      has_reopened |= robot.step_and_look(filter) == Correction::kReopened;
    }
    found += has_reopened && robot.is_found_by(filter);
  }
  return found;
}

TEST(ScaleFilter, FindsItselfAgainAfterBeingPutElsewhere) {
  EXPECT_GE(times_found_again(ScaleFilterParams{}, 40), 6);
}

TEST(ScaleFilter, KeepsThePoseThatItIsToldAfterBeingPutElsewhere) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ScaleFilter filter{flat(), ScaleFilterParams{}, kConverged};
    Wanderer robot{seed};
    for (int i = 0; i < 10; ++i) {
      robot.step_and_look(filter);
    }
    robot.be_put_elsewhere();
    filter.reset_near(robot.T_world_robot, 0.3, 0.1);
    EXPECT_EQ(filter.update(robot.look(), robot.T_odom_robot), Correction::kApplied);
    EXPECT_TRUE(robot.is_found_by(filter));
  }
}

TEST(ScaleFilter, FindsItselfAgainByWhatItsBestHypothesisCannotExplain) {
  ScaleFilterParams params;
  params.carried_share = 1.0;
  EXPECT_GE(times_found_again(params, 150), 5);
}

TEST(ScaleFilter, DoesNotReopenWhereItIsRight) {
  int reopened = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    ScaleFilter filter{flat(), ScaleFilterParams{}, kConverged};
    Wanderer robot{seed};
    filter.reset_near(robot.T_world_robot, 0.3, 0.1);
    filter.update(robot.look(), robot.T_odom_robot);
    for (int i = 0; i < 60; ++i) {
      reopened += robot.step_and_look(filter) == Correction::kReopened;
    }
    EXPECT_TRUE(robot.is_found_by(filter)) << seed;
  }
  EXPECT_EQ(reopened, 0);
}

TEST(ScaleFilter, StartsAtAGivenHeadingWhateverTheOdometrySays) {
  for (const Heading odometry : kHeadings) {
    ScaleFilter filter{flat(), ScaleFilterParams{}, kConverged};
    filter.reset_heading(Heading::kNorth);
    EXPECT_NEAR(mass_of(filter.localization().belief, Heading::kNorth), 1.0, 1e-5);
    filter.update(LocalOccupancy{64, 0.2}, {3.0, -1.0, yaw(odometry)});
    EXPECT_NEAR(mass_of(filter.localization().belief, Heading::kNorth), 1.0, 1e-5);
    // Turning left it faces west.
    filter.update(LocalOccupancy{64, 0.2}, {3.0, -1.0, yaw(odometry) + kPi / 2.0});
    EXPECT_NEAR(mass_of(filter.localization().belief, Heading::kWest), 1.0, 1e-5);
    EXPECT_NEAR(filter.localization().yaw_rad, kPi, 1e-9);
  }
}

TEST(ScaleFilter, StartsNearAGivenPose) {
  ScaleFilter filter{flat(), ScaleFilterParams{}, kConverged};
  ASSERT_TRUE(filter.reset_near({1.25, 0.75, -kPi / 2.0}, 0.3, 0.1));
  expect_distribution(filter);
  EXPECT_EQ(filter.localization().estimate.heading, Heading::kSouth);
  EXPECT_LE(norm(filter.localization().position_cells - Point2{2.5, 1.5}), 0.5);
  // Far from all that is free nothing changes.
  const Belief before = filter.localization().belief;
  EXPECT_FALSE(filter.reset_near({-40.0, 0.75, 0.0}, 0.3, 0.1));
  for (const Heading h : kHeadings) {
    EXPECT_EQ(filter.localization().belief.layer(h), before.layer(h));
  }
  filter.reset();
  EXPECT_NEAR(mass_of(filter.localization().belief, Heading::kSouth), 0.25, 1e-5);
}

TEST(ScaleFilter, AnEmptyLookSaysNothing) {
  ScaleFilter filter{flat(), ScaleFilterParams{}, kConverged};
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(filter.update(LocalOccupancy{64, 0.2}, {0.3 * i, 0.0, 0.0}), Correction::kApplied);
    expect_distribution(filter);
    EXPECT_EQ(filter.fit(), 0.0);
  }
}

TEST(ScaleFilter, ALookFromTheSamePlaceIsNoNews) {
  ScaleFilter filter{flat(), ScaleFilterParams{}, kConverged};
  Wanderer robot{1};
  const LocalOccupancy seen = robot.look();
  filter.update(seen, robot.T_odom_robot);
  const Belief before = filter.localization().belief;
  for (int i = 0; i < 20; ++i) {
    filter.update(seen, robot.T_odom_robot);
  }
  for (const Heading h : kHeadings) {
    EXPECT_EQ(filter.localization().belief.layer(h), before.layer(h));
  }
}

TEST(ScaleFilter, WithOneScaleItKeepsToTheNominalOne) {
  ScaleFilterParams params;
  params.scales = 1;
  const ScaleFilter filter{flat(), params, kConverged};
  EXPECT_EQ(filter.scale_marginal().size(), 1U);
  EXPECT_EQ(filter.scale_of(0), 1.0);
  EXPECT_NEAR(filter.localization().scale, 1.0, 1e-12);
}

}  // namespace
}  // namespace cmn
