// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/ray_profile.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kCell_m = 0.05;

/// 8 m x 8 m, all seen, free within 2 m ahead, 3 m behind, 1 m left and 1.5 m right.
LocalOccupancy box() {
  LocalOccupancy seen{160, kCell_m};
  for (int iy = 0; iy < seen.size; ++iy) {
    for (int ix = 0; ix < seen.size; ++ix) {
      const double x = (ix + 0.5 - 80) * kCell_m;
      const double y = (iy + 0.5 - 80) * kCell_m;
      const bool is_free = x > -3.0 && x < 2.0 && y > -1.5 && y < 1.0;
      seen.occupancy[seen.index_of(ix, iy)] = is_free ? 0.0F : 1.0F;
      seen.confidence[seen.index_of(ix, iy)] = 1.0F;
    }
  }
  return seen;
}

double wall_of_box(double bearing) {
  const double c = std::cos(bearing);
  const double s = std::sin(bearing);
  const double along = c > 0.0 ? 2.0 / c : -3.0 / c;
  const double across = s > 0.0 ? 1.0 / s : -1.5 / s;
  return std::min(std::abs(along), std::abs(across));
}

TEST(RayProfile, MeetsTheWallsOfABoxWhereTheyAre) {
  const RayProfile rays = cast_rays(box(), 0.0, 8.0);
  for (int b = 0; b < kBearings; ++b) {
    SCOPED_TRACE("bearing " + std::to_string(b));
    const Ray ray = rays[static_cast<std::size_t>(b)];
    EXPECT_TRUE(ray.is_hit);
    EXPECT_NEAR(ray.range_m, wall_of_box(bearing_rad(b)), kCell_m);
  }
}

TEST(RayProfile, EndsWithoutAHitWhereNobodyLooked) {
  LocalOccupancy seen = box();
  for (int iy = 0; iy < seen.size; ++iy) {
    for (int ix = 100; ix < seen.size; ++ix) {  // from 1 m ahead on
      seen.confidence[seen.index_of(ix, iy)] = 0.0F;
    }
  }
  const RayProfile rays = cast_rays(seen, 0.0, 8.0);
  EXPECT_FALSE(rays[0].is_hit);
  EXPECT_TRUE(rays[0].is_known());
  EXPECT_NEAR(rays[0].range_m, 1.0, kCell_m);
  EXPECT_LE(rays[0].range_m, 1.0);
  EXPECT_TRUE(rays[kBearings / 2].is_hit);
}

TEST(RayProfile, OfAnUnseenPlaceNothingIsKnown) {
  for (const Ray& ray : cast_rays(LocalOccupancy{160, kCell_m}, 0.3, 8.0)) {
    EXPECT_FALSE(ray.is_known());
    EXPECT_FALSE(ray.is_hit);
  }
}

TEST(RayProfile, LeavesTheCellsUnderTheRobotUnasked) {
  // Four looks of less than a quarter, as of a narrow camera, leave the diagonals unseen.
  LocalOccupancy seen = box();
  for (int iy = 0; iy < seen.size; ++iy) {
    for (int ix = 0; ix < seen.size; ++ix) {
      const double bearing = std::atan2(iy + 0.5 - 80, ix + 0.5 - 80);
      if (std::abs(std::remainder(bearing, kPi / 2.0)) > 0.6) {
        seen.confidence[seen.index_of(ix, iy)] = 0.0F;
      }
    }
  }
  const RayProfile rays = cast_rays(seen, 0.0, 8.0);
  for (const int b : {0, 9, 18, 27}) {
    SCOPED_TRACE("bearing " + std::to_string(b));
    const Ray ray = rays[static_cast<std::size_t>(b)];
    EXPECT_TRUE(ray.is_hit);
    EXPECT_NEAR(ray.range_m, wall_of_box(bearing_rad(b)), kCell_m);
  }
  for (const int b : {4, 5, 13, 14}) {
    EXPECT_FALSE(rays[static_cast<std::size_t>(b)].is_known()) << "bearing " << b;
  }
}

TEST(RayProfile, EndsAtItsReachAndWithinTheGrid) {
  const RayProfile near = cast_rays(box(), 0.0, 0.8);
  for (const Ray& ray : near) {
    EXPECT_FALSE(ray.is_hit);
    EXPECT_NEAR(ray.range_m, 0.8, kCell_m);
  }
  LocalOccupancy open = box();
  std::fill(open.occupancy.begin(), open.occupancy.end(), 0.0F);
  for (const Ray& ray : cast_rays(open, 0.7, 100.0)) {
    EXPECT_FALSE(ray.is_hit);
    EXPECT_NEAR(ray.range_m, 4.0, 2.0 * kCell_m);
  }
}

TEST(RayProfile, BeginsBeyondTheGroundThatTheRobotStandsOn) {
  // Four looks of a camera leave the corners unseen, and with them the cells about the middle.
  LocalOccupancy seen = box();
  const auto for_each_within = [&](double radius_m, auto&& visit) {
    for (int iy = 0; iy < seen.size; ++iy) {
      for (int ix = 0; ix < seen.size; ++ix) {
        const Point2 p{(ix + 0.5 - 0.5 * seen.size) * seen.resolution,
                       (iy + 0.5 - 0.5 * seen.size) * seen.resolution};
        if (norm(p) < radius_m) {
          visit(seen.index_of(ix, iy));
        }
      }
    }
  };
  for_each_within(0.12, [&](std::size_t i) { seen.confidence[i] = 0.0F; });
  const RayProfile whole = cast_rays(box(), 0.0, 8.0);
  const RayProfile rays = cast_rays(seen, 0.0, 8.0);
  for (std::size_t b = 0; b < rays.size(); ++b) {
    EXPECT_EQ(rays[b].range_m, whole[b].range_m);
    EXPECT_EQ(rays[b].is_hit, whole[b].is_hit);
  }
  for_each_within(0.5, [&](std::size_t i) { seen.confidence[i] = 0.0F; });
  for (const Ray& ray : cast_rays(seen, 0.0, 8.0)) {
    EXPECT_FALSE(ray.is_known());
  }
}

TEST(RayProfile, DoesNotTurnWithTheGrid) {
  const RayProfile rays = cast_rays(box(), 0.0, 8.0);
  for (const int by : {1, 5, kBearingsPerQuarter, 20, -3}) {
    SCOPED_TRACE("turned by " + std::to_string(by));
    const RayProfile turned_rays = cast_rays(box(), bearing_rad(by), 8.0);
    for (int b = 0; b < kBearings; ++b) {
      const auto there = static_cast<std::size_t>((b + by + kBearings) % kBearings);
      EXPECT_NEAR(turned_rays[there].range_m, rays[static_cast<std::size_t>(b)].range_m,
                  0.51 * kCell_m);
    }
  }
}

}  // namespace
}  // namespace cmn
