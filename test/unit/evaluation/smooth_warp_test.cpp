// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/smooth_warp.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(Jacobian2, StretchesAndRotationOfATurnedScaling) {
  // Stretch by 3 along x and 2 along y, then turn by 0.4 rad.
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  const Jacobian2 j{3.0 * c, -2.0 * s, 3.0 * s, 2.0 * c};
  EXPECT_NEAR(j.stretches().first, 2.0, 1e-12);
  EXPECT_NEAR(j.stretches().second, 3.0, 1e-12);
  EXPECT_NEAR(j.rotation(), 0.4, 1e-12);
  EXPECT_NEAR(j.determinant(), 6.0, 1e-12);
}

TEST(SmoothWarp, IdentityHasNoWaves) {
  const SmoothWarp warp;
  EXPECT_EQ(warp({3.0, -2.0}).x, 3.0);
  EXPECT_EQ(warp.inverse({3.0, -2.0}).y, -2.0);
  EXPECT_EQ(warp.slope_bound(), 0.0);
}

TEST(SmoothWarp, OneWaveByHand) {
  const SmoothWarp warp{{{{0.5, 0.0}, {0.2, 0.0}, 0.0}}};  // x + 0.2 sin(x / 2)
  EXPECT_NEAR(warp({kPi, 7.0}).x, kPi + 0.2, 1e-12);
  EXPECT_NEAR(warp({kPi, 7.0}).y, 7.0, 1e-12);
  EXPECT_NEAR(warp.jacobian({0.0, 7.0}).xx, 1.1, 1e-12);
  EXPECT_NEAR(warp.slope_bound(), 0.1, 1e-12);
}

TEST(SmoothWarp, WavesThatCouldFoldAreRefused) {
  EXPECT_THROW((SmoothWarp{{{{2.0, 0.0}, {0.5, 0.0}, 0.0}}}), std::invalid_argument);
}

TEST(SmoothWarp, AnyWarpIsInvertibleKeepsOrientationAndItsBound) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const double slope = 0.94 * draw_uniform(rng);
    const SmoothWarp warp = draw_warp(rng, slope, 2.0 + 10.0 * draw_uniform(rng), 0.3);
    EXPECT_NEAR(warp.slope_bound(), slope, 1e-12);
    for (int i = 0; i < 50; ++i) {
      const Point2 p{200.0 * draw_uniform(rng) - 100.0, 200.0 * draw_uniform(rng) - 100.0};
      EXPECT_NEAR(norm(warp.inverse(warp(p)) - p), 0.0, 1e-8);
      EXPECT_NEAR(norm(warp(warp.inverse(p)) - p), 0.0, 1e-8);
      const Jacobian2 j = warp.jacobian(p);
      EXPECT_GT(j.determinant(), 0.0);
      EXPECT_GE(j.stretches().first, 1.0 - slope - 1e-12);
      EXPECT_LE(j.stretches().second, 1.0 + slope + 1e-12);
      const double h = 1e-6;  // the derivative is that of the map
      const Point2 dx = (0.5 / h) * (warp(p + Point2{h, 0.0}) - warp(p - Point2{h, 0.0}));
      const Point2 dy = (0.5 / h) * (warp(p + Point2{0.0, h}) - warp(p - Point2{0.0, h}));
      EXPECT_NEAR(norm(dx - Point2{j.xx, j.yx}), 0.0, 1e-6);
      EXPECT_NEAR(norm(dy - Point2{j.xy, j.yy}), 0.0, 1e-6);
    }
  }
}

}  // namespace
}  // namespace cmn
