// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/sight_score.hpp"

#include <cmath>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

/// A room of 4 m x 4 m in cells of 1 m, with a post of 1 m2 in it.
World room() {
  return World{ascii_map({"######", "#....#", "#..#.#", "#....#", "#....#", "######"}, 1.0)};
}

const Pose2 kHere{2.5, 2.5, 0.3};

/// What a LiDAR of so many degrees without errors sees of it.
LocalOccupancy seen_by_lidar(const World& world, double field_of_view_deg) {
  LidarParams lidar;
  lidar.beams = static_cast<int>(2.0 * field_of_view_deg);
  lidar.field_of_view_deg = field_of_view_deg;
  lidar.noise_m = lidar.noise_share = lidar.dropout = 0.0;
  return RangeProjector{{160, 8.0, 0.0}}.project(RangeSensor{lidar, 1}.measure(world, kHere, 0.0));
}

TEST(SightScore, OfAPerfectLookIsOne) {
  const World world = room();
  SightScore score{world};
  score.add(seen_by_lidar(world, 360.0), kHere);
  EXPECT_GT(score.free_iou(), 0.99);
  EXPECT_GT(score.obstacle_iou(), 0.99);
}

TEST(SightScore, WhatWasNotLookedAtIsMissed) {
  const World world = room();
  SightScore score{world};
  score.add(seen_by_lidar(world, 180.0), kHere);
  EXPECT_NEAR(score.free_iou(), 0.5, 0.15);
  EXPECT_LT(score.obstacle_iou(), 0.8);
  SightScore blind{world};
  blind.add(LocalOccupancy{160, 0.05}, kHere);
  EXPECT_EQ(blind.free_iou(), 0.0);
  EXPECT_EQ(blind.obstacle_iou(), 0.0);
}

TEST(SightScore, WhatIsSeenThroughAnObstacleIsWrong) {
  const World world = room();
  // The post is not seen: as a table by a LiDAR below its top.
  const World empty{ascii_map({"######", "#....#", "#....#", "#....#", "#....#", "######"}, 1.0)};
  SightScore score{world};
  score.add(seen_by_lidar(empty, 360.0), kHere);
  EXPECT_LT(score.obstacle_iou(), 0.9);
  SightScore ghost{empty};
  ghost.add(seen_by_lidar(world, 360.0), kHere);
  EXPECT_LT(ghost.free_iou(), 0.95);
  EXPECT_LT(ghost.obstacle_iou(), 0.95);
}

TEST(SightScore, OfNoLooksIsNoNumber) {
  const World world = room();
  EXPECT_TRUE(std::isnan(SightScore{world}.free_iou()));
  EXPECT_TRUE(std::isnan(SightScore{world}.obstacle_iou()));
}

}  // namespace
}  // namespace cmn
