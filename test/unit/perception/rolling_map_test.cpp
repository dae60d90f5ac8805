// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/rolling_map.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr int kSize = 60;
constexpr double kCell_m = 0.1;

RollingMapParams lasting() {
  RollingMapParams params;
  params.memory_m = 1000.0;
  return params;
}

LocalOccupancy nothing() { return LocalOccupancy{kSize, kCell_m}; }

/// All seen, all of one occupancy.
LocalOccupancy all(float occupancy) {
  LocalOccupancy look = nothing();
  std::fill(look.occupancy.begin(), look.occupancy.end(), occupancy);
  std::fill(look.confidence.begin(), look.confidence.end(), 1.0F);
  return look;
}

Point2 place_of(int ix, int iy) {
  return {(ix + 0.5 - 0.5 * kSize) * kCell_m, (iy + 0.5 - 0.5 * kSize) * kCell_m};
}

/// Free ground with a post of 0.2 m about a point of the robot's frame.
LocalOccupancy look_at_post(Point2 post) {
  LocalOccupancy look = all(0.0F);
  for (int iy = 0; iy < kSize; ++iy) {
    for (int ix = 0; ix < kSize; ++ix) {
      const Point2 off = place_of(ix, iy) - post;
      if (std::max(std::abs(off.x), std::abs(off.y)) < 0.1) {
        look.occupancy[look.index_of(ix, iy)] = 1.0F;
      }
    }
  }
  return look;
}

/// Where something is known to stand, in the robot's frame.
std::vector<Point2> occupied(const LocalOccupancy& known) {
  std::vector<Point2> places;
  for (int iy = 0; iy < kSize; ++iy) {
    for (int ix = 0; ix < kSize; ++ix) {
      const std::size_t i = known.index_of(ix, iy);
      if (known.confidence[i] > 0.0F && known.occupancy[i] > 0.5F) {
        places.push_back(place_of(ix, iy));
      }
    }
  }
  return places;
}

float most_confident(const LocalOccupancy& known) {
  return *std::max_element(known.confidence.begin(), known.confidence.end());
}

TEST(RollingMap, WhatWasSeenStaysWhereItIs) {
  const Point2 post{1.3, 0.7};
  RollingMap map{lasting()};
  Pose2 T_odom_robot{5.03, -2.96, 0.4};
  const Point2 p_odom = T_odom_robot * post;
  map.fuse(look_at_post(post), T_odom_robot);
  for (int i = 0; i < 60; ++i) {  // on a circle of 0.8 m around, looking at nothing
    SCOPED_TRACE("step " + std::to_string(i));
    T_odom_robot = T_odom_robot * Pose2{0.1, 0.0, 0.125};
    const Point2 expected = inverse(T_odom_robot) * p_odom;
    const std::vector<Point2> found = occupied(map.fuse(nothing(), T_odom_robot));
    ASSERT_GE(found.size(), 2U);
    ASSERT_LE(found.size(), 9U);
    Point2 mean;
    for (const Point2 p : found) {
      ASSERT_LE(norm(p - expected), 0.1 * std::sqrt(2.0) + 1.5 * kCell_m);
      mean = mean + (1.0 / static_cast<double>(found.size())) * p;
    }
    ASSERT_LE(norm(mean - expected), kCell_m);
  }
}

TEST(RollingMap, ANewLookOverrulesAnOldOne) {
  RollingMap map{lasting()};
  for (int i = 0; i < 20; ++i) {
    map.fuse(all(1.0F), {});
  }
  for (const float occupancy : map.fuse(all(0.0F), {}).occupancy) {
    ASSERT_LT(occupancy, 0.5F);
  }
  // And of two equal ones the mean, weighed by confidence, stays between them.
  RollingMapParams patient = lasting();
  patient.most_looks = 100.0;
  RollingMap slow{patient};
  for (int i = 0; i < 3; ++i) {
    slow.fuse(all(1.0F), {});
  }
  const LocalOccupancy known = slow.fuse(all(0.0F), {});
  EXPECT_NEAR(known.occupancy[0], 0.75F, 1e-6F);
  EXPECT_NEAR(known.confidence[0], 4.0F, 1e-6F);
}

TEST(RollingMap, WhatIsNotSeenAgainFadesWithTheWay) {
  RollingMapParams params;
  params.memory_m = 2.0;
  params.most_looks = 1.0;
  RollingMap map{params};
  map.fuse(all(0.0F), {});
  for (int i = 1; i <= 10; ++i) {
    const float faded = static_cast<float>(std::exp(-0.1 * i / params.memory_m));
    EXPECT_NEAR(most_confident(map.fuse(nothing(), {0.1 * i, 0.0, 0.3 * i})), faded, 1e-5F);
  }
  // At rest it does not, and in the end it is gone.
  EXPECT_NEAR(most_confident(map.fuse(nothing(), {1.0, 0.0, 0.0})), std::exp(-0.5F), 1e-5F);
  float last = 1.0F;
  for (int i = 0; i < 80; ++i) {
    last = most_confident(map.fuse(nothing(), {i % 2 == 0 ? 1.1 : 1.0, 0.0, 0.0}));
  }
  EXPECT_EQ(last, 0.0F);
}

/// What is seen in a room of 5 x 4 m from a pose in it: free up to its walls, which are 0.2 m
/// thick.
LocalOccupancy look_at_room(const Pose2& T_room_robot) {
  LocalOccupancy look = nothing();
  for (int iy = 0; iy < kSize; ++iy) {
    for (int ix = 0; ix < kSize; ++ix) {
      const Point2 p = T_room_robot * place_of(ix, iy);
      const double depth = std::min({p.x, 5.0 - p.x, p.y, 4.0 - p.y});
      const std::size_t i = look.index_of(ix, iy);
      look.occupancy[i] = depth > 0.0 ? 0.0F : 1.0F;
      look.confidence[i] = depth > -0.2 ? 1.0F : 0.0F;
    }
  }
  return look;
}

/// How much of what is known to be occupied lies farther than 0.2 m from the room's walls after a
/// look to either side and many turns on the spot, of which odometry misses some degrees each.
double share_of_ghosts(bool is_aligned) {
  RollingMapParams params = lasting();
  params.most_looks = 1.0;
  params.align.enabled = is_aligned;
  RollingMap map{params};
  Pose2 T_room_robot{2.2, 1.7, 0.0};
  Pose2 T_odom_robot{-7.0, 3.0, 1.0};
  LocalOccupancy known;
  for (int i = 0; i < 12; ++i) {
    LocalOccupancy look = look_at_room(T_room_robot);
    for (int iy = 0; iy < kSize; ++iy) {  // sees what is ahead
      for (int ix = 0; ix < kSize / 2 - 5; ++ix) {
        look.confidence[look.index_of(ix, iy)] = 0.0F;
      }
    }
    known = map.fuse(look, T_odom_robot);
    T_room_robot.yaw += kPi / 2.0;
    T_odom_robot.yaw += kPi / 2.0 - 3.0 * kPi / 180.0;
  }
  T_room_robot.yaw -= kPi / 2.0;
  double ghosts = 0.0;
  const std::vector<Point2> found = occupied(known);
  for (const Point2 p_robot : found) {
    const Point2 p = T_room_robot * p_robot;
    ghosts += std::abs(std::min({p.x, 5.0 - p.x, p.y, 4.0 - p.y}) + 0.1) > 0.3;
  }
  return ghosts / static_cast<double>(found.size());
}

TEST(RollingMap, ItsWallsStayWhereTheyAreAlthoughOdometryTurnsAway) {
  EXPECT_GT(share_of_ghosts(false), 0.05) << "as odometry says";
  EXPECT_EQ(share_of_ghosts(true), 0.0);
}

TEST(RollingMap, KnowsByHowMuchTheHeadingHasDrifted) {
  RollingMap map{lasting()};
  EXPECT_FALSE(map.heading_drift()) << "nothing was seen yet";
  Pose2 T_room_robot{2.2, 1.7, 0.3};
  Pose2 T_odom_robot{4.0, -2.0, 0.3};
  map.fuse(look_at_room(T_room_robot), T_odom_robot);
  EXPECT_EQ(map.heading_drift()->rad, 0.0);
  for (int i = 0; i < 12; ++i) {  // a turn by which odometry gains a degree, and a step
    T_room_robot = T_room_robot * Pose2{0.05, 0.0, 0.5};
    T_odom_robot = T_odom_robot * Pose2{0.05, 0.0, 0.5 + kPi / 180.0};
    map.fuse(look_at_room(T_room_robot), T_odom_robot);
    ASSERT_NEAR(map.heading_drift()->rad, (i + 1) * kPi / 180.0, 3.0 * kPi / 180.0) << i;
  }
  // What it has told of goes on when all else is forgotten.
  const double before = map.heading_drift()->rad;
  map.forget();
  map.fuse(look_at_room(T_room_robot), T_odom_robot);
  EXPECT_EQ(map.heading_drift()->rad, before);
}

TEST(RollingMap, DoesNotCreepRoundWithARobotThatTurnsToAndFro) {
  RollingMap map{lasting()};
  Pose2 T_room_robot{2.2, 1.7, 0.0};
  Pose2 T_odom_robot = T_room_robot;
  for (int i = 0; i < 400; ++i) {
    map.fuse(look_at_room(T_room_robot), T_odom_robot);
    const double turn = i % 2 == 0 ? kPi / 2.0 : -kPi / 2.0;
    T_room_robot.yaw += turn;
    T_odom_robot.yaw += turn + 0.1 * kPi / 180.0;  // far less than what shows in a cell
  }
  EXPECT_NEAR(map.heading_drift()->rad * 180.0 / kPi, 40.0, 4.0);
}

TEST(RollingMap, ForgetsWhenItIsCarriedElsewhere) {
  // From the middle of the room to near its corner: old walls are left behind the new ones.
  const auto farthest_behind = [](double carried_share) {
    RollingMapParams params = lasting();
    params.carried_share = carried_share;
    RollingMap map{params};
    map.fuse(look_at_room({2.5, 2.0, 0.0}), {});
    double least = 0.0;
    for (const Point2 p : occupied(map.fuse(look_at_room({1.2, 1.0, 0.0}), {0.15, 0.0, 0.0}))) {
      least = std::min(least, p.x);
    }
    return least;
  };
  EXPECT_GT(farthest_behind(RollingMapParams{}.carried_share), -1.5);
  EXPECT_LT(farthest_behind(1.0), -2.0);
}

TEST(RollingMap, WhatLeavesTheWindowIsGone) {
  for (const double step_m : {0.1, 0.35, -0.7, 9.0, -30.0}) {
    for (const bool is_along_x : {true, false}) {
      SCOPED_TRACE("steps of " + std::to_string(step_m));
      RollingMap map{lasting()};
      map.fuse(all(1.0F), {});
      Pose2 T_odom_robot;
      while (norm(T_odom_robot.position()) < 30.0) {
        (is_along_x ? T_odom_robot.x : T_odom_robot.y) += step_m;
        const LocalOccupancy known = map.fuse(nothing(), T_odom_robot);
        for (const Point2 p : occupied(known)) {
          const Point2 p_odom = T_odom_robot * p;
          // No ghosts from the other end of the torus.
          ASSERT_LE(std::max(std::abs(p_odom.x), std::abs(p_odom.y)), 3.0 + kCell_m);
        }
      }
      EXPECT_EQ(most_confident(map.fuse(nothing(), {})), 0.0F);
    }
  }
}

TEST(RollingMap, ForgetsWhenTold) {
  RollingMap map{lasting()};
  map.fuse(all(1.0F), {});
  map.forget();
  EXPECT_EQ(most_confident(map.fuse(nothing(), {})), 0.0F);
}

TEST(RollingMap, BeginsAnewWithALookOfAnotherSize) {
  RollingMap map{lasting()};
  map.fuse(all(1.0F), {});
  const LocalOccupancy known = map.fuse(LocalOccupancy{20, 0.05}, {});
  EXPECT_EQ(known.size, 20);
  EXPECT_EQ(most_confident(known), 0.0F);
}

TEST(RollingMap, OfTheFirstLookNothingIsLost) {
  const LocalOccupancy look = look_at_post({1.25, 0.75});
  LocalOccupancy known = RollingMap{RollingMapParams{}}.fuse(look, {});
  EXPECT_EQ(known.occupancy, look.occupancy);
  EXPECT_EQ(known.resolution, look.resolution);
}

}  // namespace
}  // namespace cmn
