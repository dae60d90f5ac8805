// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/downsample.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace cmn {
namespace {

CoarseMap random_map(std::mt19937_64& rng, double resolution) {
  Grid<std::uint8_t> occupied{1 + static_cast<int>(draw_index(rng, 40)),
                              1 + static_cast<int>(draw_index(rng, 40))};
  const double share = draw_uniform(rng);
  for (auto& o : occupied.values()) {
    o = draw_uniform(rng) < share ? 1 : 0;
  }
  return {occupied, resolution, {-3.0, 2.0, 0.5}};
}

/// The rule itself: share of a coarse cell that is free, fine cell by fine cell.
double free_share(const CoarseMap& world, Cell coarse, double ratio) {
  const auto overlap = [&](int fine, int at) {
    const double lo = std::max<double>(fine, at * ratio);
    const double hi = std::min<double>(fine + 1.0, (at + 1) * ratio);
    return std::max(0.0, hi - lo);
  };
  double area = 0.0;
  for (int y = 0; y < world.height(); ++y) {
    for (int x = 0; x < world.width(); ++x) {
      area += world.is_free({x, y}) ? overlap(x, coarse.x) * overlap(y, coarse.y) : 0.0;
    }
  }
  return area / (ratio * ratio);
}

TEST(DownsampleProperty, ACellIsOccupiedWhenMoreThanHalfOfItIs) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const CoarseMap world = random_map(rng, 0.05);
    for (const double resolution : {0.05, 0.07, 0.1, 0.3, 0.4, 0.5, 5.0}) {
      SCOPED_TRACE(resolution);
      const CoarseMap coarse = downsampled(world, resolution);
      const double ratio = resolution / 0.05;
      ASSERT_EQ(coarse.width(), static_cast<int>(std::ceil(world.width() / ratio - 1e-6)));
      ASSERT_EQ(coarse.height(), static_cast<int>(std::ceil(world.height() / ratio - 1e-6)));
      for (std::size_t i = 0; i < coarse.occupied().size(); ++i) {
        const Cell c = coarse.occupied().cell_at(i);
        const double share = free_share(world, c, ratio);
        ASSERT_EQ(coarse.is_free(c), share > 0.5 - 1e-6) << c.x << ", " << c.y << ": " << share;
      }
    }
  }
}

TEST(DownsampleProperty, TheSameResolutionChangesNothing) {
  std::mt19937_64 rng{1};
  for (const double resolution : {0.05, 0.1, 1.0 / 3.0}) {
    const CoarseMap world = random_map(rng, resolution);
    EXPECT_TRUE(downsampled(world, resolution).occupied() == world.occupied());
  }
}

TEST(DownsampleProperty, APlaceKeepsItsCoordinates) {
  std::mt19937_64 rng{2};
  const CoarseMap world = random_map(rng, 0.05);
  const CoarseMap coarse = downsampled(world, 0.3);
  for (std::size_t i = 0; i < world.occupied().size(); ++i) {
    const Cell fine = world.occupied().cell_at(i);
    EXPECT_TRUE(coarse.cell_of(world.center_of(fine)) == (Cell{fine.x / 6, fine.y / 6}));
  }
}

TEST(Downsample, RefusesAFinerOrSenselessResolution) {
  const CoarseMap world{Grid<std::uint8_t>{4, 4}, 0.4};
  for (const double resolution : {0.3, 0.0, -1.0, std::nan(""), 1.0 / 0.0}) {
    EXPECT_THROW(downsampled(world, resolution), std::invalid_argument) << resolution;
  }
}

}  // namespace
}  // namespace cmn
