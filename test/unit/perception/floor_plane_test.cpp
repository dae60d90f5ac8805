// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/floor_plane.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace cmn {
namespace {

/// `floor` points of a plane and `others` of things on it that could be floor.
std::vector<Eigen::Vector3f> points_of(const FloorEstimator& estimator, const FloorPlane& plane,
                                       int floor, int others, std::uint64_t seed) {
  std::mt19937_64 rng{seed};
  const auto between = [&rng](double low, double high) {
    return static_cast<float>(low + (high - low) * draw_uniform(rng));
  };
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < floor + others; ++i) {
    Eigen::Vector3f p{between(0.6, 3.0), between(-1.5, 1.5), 0.0F};
    p.z() = plane.at(p.x(), p.y()) + static_cast<float>(0.004 * draw_normal(rng));
    p.z() += i < floor ? 0.0F : between(0.0, 0.2);
    if (estimator.is_candidate(p)) {
      points.push_back(p);
    }
  }
  return points;
}

TEST(FloorEstimator, FindsATiltedFloorAmongThingsThatStandOnIt) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const double direction = 6.28 * draw_uniform(rng);
    const double tilt = std::tan(2.0 * 3.14159 / 180.0);
    const FloorPlane truth{{static_cast<float>(tilt * std::cos(direction)),
                            static_cast<float>(tilt * std::sin(direction))},
                           static_cast<float>(0.02 * (draw_uniform(rng) - 0.5))};
    FloorEstimator estimator{FloorParams{}};
    const FloorPlane plane = estimator.fit(points_of(estimator, truth, 800, 800, seed));
    EXPECT_EQ(estimator.source(), FloorSource::kSeen);
    EXPECT_LT((plane.slope - truth.slope).norm(), 0.006F) << "a third of a degree";
    EXPECT_NEAR(plane.offset_m, truth.offset_m, 0.01);
  }
}

TEST(FloorEstimator, WithoutFloorInViewTheLastOneStandsInAndBeforeThatTheNominalOne) {
  FloorEstimator estimator{FloorParams{}};
  const FloorPlane truth{{0.02F, 0.0F}, 0.01F};
  EXPECT_EQ(estimator.fit({}).slope.norm(), 0.0F);
  EXPECT_EQ(estimator.source(), FloorSource::kNominal);
  const FloorPlane seen = estimator.fit(points_of(estimator, truth, 800, 0, 1));
  EXPECT_EQ(estimator.source(), FloorSource::kSeen);
  EXPECT_EQ(estimator.fit(points_of(estimator, truth, 20, 0, 2)).slope, seen.slope);
  EXPECT_EQ(estimator.source(), FloorSource::kLast);
  // A line of floor does not tell how it slopes.
  std::vector<Eigen::Vector3f> line;
  for (int i = 0; i < 500; ++i) {
    line.emplace_back(1.0F + 0.002F * static_cast<float>(i), 0.0F, 0.03F);
  }
  EXPECT_EQ(estimator.fit(line).slope, seen.slope);
  EXPECT_EQ(estimator.source(), FloorSource::kLast);
}

TEST(FloorEstimator, WhatIsTooSteepOrTooHighIsNoFloor) {
  FloorEstimator estimator{FloorParams{}};
  EXPECT_FALSE(estimator.is_candidate({1.0F, 0.0F, 0.2F}));
  EXPECT_FALSE(estimator.is_candidate({4.0F, 0.0F, 0.0F}));
  const FloorPlane ramp{{0.12F, 0.0F}, 0.0F};
  const FloorPlane plane = estimator.fit(points_of(estimator, ramp, 800, 0, 3));
  EXPECT_LE(plane.slope.norm(), std::tan(3.0 * 3.1416 / 180.0));
}

}  // namespace
}  // namespace cmn
