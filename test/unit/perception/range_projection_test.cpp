// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/range_projection.hpp"

#include "coarse_map_nav/perception/obstacle_guard.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

RangeScan full_circle(float range_m, std::size_t beams = 360) {
  RangeScan scan;
  scan.angle_min_rad = -kPi;
  scan.angle_increment_rad = 2.0 * kPi / static_cast<double>(beams);
  scan.range_min_m = 0.1;
  scan.range_max_m = 8.0;
  scan.ranges_m.assign(beams, range_m);
  return scan;
}

/// The cell that holds a point of the robot's frame.
std::size_t at(const LocalOccupancy& local, double x, double y) {
  const auto bin = [&](double v) {
    return static_cast<int>(std::floor(v / local.resolution)) + local.size / 2;
  };
  return local.index_of(bin(x), bin(y));
}

TEST(RangeProjector, IsFreeUpToTheHitOccupiedThereAndUnseenBehind) {
  RangeProjector projector{ProjectionParams{}};
  const LocalOccupancy local = projector.project(full_circle(0.4F));
  EXPECT_EQ(local.occupancy[at(local, 0.3, 0.0)], 0.0F);
  EXPECT_EQ(local.confidence[at(local, 0.3, 0.0)], 1.0F);
  EXPECT_EQ(local.occupancy[at(local, 0.405, 0.0)], 1.0F);
  EXPECT_EQ(local.confidence[at(local, 0.405, 0.0)], 1.0F);
  EXPECT_EQ(local.occupancy[at(local, 0.0, -0.6)], 1.0F);
  EXPECT_EQ(local.confidence[at(local, 0.0, -0.6)], 0.0F);
}

TEST(RangeProjector, ABeamThatMetNothingIsFreeAllTheWay) {
  RangeProjector projector{ProjectionParams{}};
  for (const float range : {kInf, 100.0F}) {
    const LocalOccupancy local = projector.project(full_circle(range));
    for (std::size_t i = 0; i < local.cell_count(); ++i) {
      ASSERT_EQ(local.occupancy[i], 0.0F);
      ASSERT_EQ(local.confidence[i], 1.0F);
    }
  }
}

TEST(RangeProjector, ALostEchoIsNoSlitInAWall) {
  ProjectionParams params;
  params.side_m = 6.4;
  RangeProjector projector{params};
  RangeScan scan = full_circle(2.0F);
  scan.ranges_m[180] = kInf;  // straight ahead
  LocalOccupancy local = projector.project(scan);
  EXPECT_EQ(local.occupancy[at(local, 1.9, 0.0)], 0.0F);
  EXPECT_EQ(local.confidence[at(local, 1.9, 0.0)], 1.0F);
  EXPECT_EQ(local.confidence[at(local, 2.5, 0.0)], 0.0F);
  // Several in a row are an opening, and so is one of a sparse scan.
  scan.ranges_m[179] = scan.ranges_m[181] = kInf;
  local = projector.project(scan);
  EXPECT_EQ(local.occupancy[at(local, 2.5, 0.0)], 0.0F);
  EXPECT_EQ(local.confidence[at(local, 2.5, 0.0)], 1.0F);
  scan = full_circle(2.0F, 36);
  scan.ranges_m[18] = kInf;
  EXPECT_EQ(projector.project(scan).confidence[at(local, 2.5, 0.0)], 1.0F);
}

TEST(RangeProjector, ABeamThatMetNothingSaysNothingBeyondItsReach) {
  RangeProjector projector{ProjectionParams{}};
  RangeScan scan = full_circle(kInf);
  scan.range_max_m = 0.3;
  const LocalOccupancy local = projector.project(scan);
  EXPECT_EQ(local.occupancy[at(local, 0.25, 0.0)], 0.0F);
  EXPECT_EQ(local.occupancy[at(local, 0.5, 0.0)], 0.5F);
  EXPECT_EQ(local.confidence[at(local, 0.5, 0.0)], 0.0F);
}

TEST(RangeProjector, UnusableRangesSayNothingAndAreCounted) {
  RangeProjector projector{ProjectionParams{}};
  for (const float range : {kNan, -1.0F, -kInf, 0.05F}) {
    BeamCount count;
    const LocalOccupancy local = projector.project(full_circle(range), &count);
    EXPECT_EQ(count.unusable, 360U) << range;
    EXPECT_EQ(count.used, 0U) << range;
    for (std::size_t i = 0; i < local.cell_count(); ++i) {
      ASSERT_EQ(local.occupancy[i], 0.5F);
      ASSERT_EQ(local.confidence[i], 0.0F);
    }
  }
}

TEST(RangeProjector, KnowsNothingOutsideTheFieldOfView) {
  RangeScan scan = full_circle(kInf, 181);
  scan.angle_min_rad = -kPi / 2.0;
  scan.angle_increment_rad = kPi / 180.0;
  RangeProjector projector{ProjectionParams{}};
  const LocalOccupancy local = projector.project(scan);
  EXPECT_EQ(local.confidence[at(local, 0.3, 0.2)], 1.0F);
  EXPECT_EQ(local.confidence[at(local, -0.3, 0.2)], 0.0F);
  EXPECT_EQ(local.occupancy[at(local, -0.3, 0.2)], 0.5F);
}

TEST(RangeProjector, TakesTheGroundBetweenTheRobotsMiddleAndTheSensorToBeFree) {
  RangeScan scan = full_circle(kInf, 241);  // a Hokuyo at the front of a TurtleBot 2
  scan.angle_min_rad = -120.0 * kPi / 180.0;
  scan.angle_increment_rad = kPi / 180.0;
  scan.T_robot_sensor = {0.1, 0.0, 0.0};
  RangeProjector projector{ProjectionParams{}};
  const LocalOccupancy local = projector.project(scan);
  for (const double x : {0.005, 0.055, 0.095}) {
    EXPECT_EQ(local.occupancy[at(local, x, 0.005)], 0.0F) << x;
    EXPECT_EQ(local.confidence[at(local, x, 0.005)], kPresumed) << x;
  }
  EXPECT_EQ(local.confidence[at(local, -0.1, 0.005)], 0.0F) << "it does not look back";
  EXPECT_EQ(local.confidence[at(local, 0.2, 0.0)], 1.0F);
}

TEST(RangeProjector, SeesTheSameWithASensorThatSpinsClockwise) {
  RangeScan scan = full_circle(2.0F);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    scan.ranges_m[i] = i < 90 ? 0.4F : 2.0F;
  }
  RangeScan clockwise = scan;
  clockwise.angle_min_rad = scan.angle_min_rad + 359.0 * scan.angle_increment_rad;
  clockwise.angle_increment_rad = -scan.angle_increment_rad;
  std::reverse(clockwise.ranges_m.begin(), clockwise.ranges_m.end());
  RangeProjector projector{ProjectionParams{}};
  const LocalOccupancy expected = projector.project(scan);
  EXPECT_EQ(projector.project(clockwise).occupancy, expected.occupancy);
}

TEST(RangeProjector, LooksFromTheSensorsMount) {
  RangeScan scan = full_circle(0.3F);
  scan.T_robot_sensor = {0.2, 0.1, 1.0};
  RangeProjector projector{ProjectionParams{}};
  const LocalOccupancy local = projector.project(scan);
  EXPECT_EQ(local.occupancy[at(local, 0.45, 0.1)], 0.0F);
  EXPECT_EQ(local.confidence[at(local, 0.505, 0.105)], 1.0F);
  EXPECT_EQ(local.occupancy[at(local, 0.505, 0.105)], 1.0F);
}

TEST(RangeProjector, AScanWithoutRangesOrAnglesSaysNothing) {
  RangeProjector projector{ProjectionParams{}};
  RangeScan empty = full_circle(1.0F, 360);
  empty.ranges_m.clear();
  RangeScan degenerate = full_circle(1.0F);
  degenerate.angle_increment_rad = std::numeric_limits<double>::quiet_NaN();
  for (const RangeScan& scan : {empty, degenerate}) {
    const LocalOccupancy local = projector.project(scan);
    EXPECT_EQ(*std::max_element(local.confidence.begin(), local.confidence.end()), 0.0F);
  }
}

TEST(ObstacleGuard, IsBlockedByAWallInTheFrontBlockOnly) {
  RangeProjector projector{ProjectionParams{}};
  RangeScan scan = full_circle(5.0F);
  const auto wall_at = [&](double bearing_rad, float range_m) {
    RangeScan walled = scan;
    for (std::size_t i = 0; i < walled.ranges_m.size(); ++i) {
      const double bearing =
          walled.angle_min_rad + static_cast<double>(i) * walled.angle_increment_rad;
      const double off = std::abs(wrap_angle(bearing - bearing_rad));
      if (off < 0.7) {
        walled.ranges_m[i] = range_m / static_cast<float>(std::cos(off));
      }
    }
    return clear_ahead_m(walled, projector.project(walled), ObstacleGuardParams{}) == 0.0;
  };
  EXPECT_TRUE(wall_at(0.0, 0.4F));
  EXPECT_FALSE(wall_at(0.0, 0.62F));
  EXPECT_FALSE(wall_at(kPi / 2.0, 0.4F));
  EXPECT_FALSE(wall_at(kPi, 0.4F));
  // 25 % of the block are 10.7 of its 42.7 cm: a wall nearer than 0.64 - 0.107 m blocks.
  EXPECT_TRUE(wall_at(0.0, 0.51F));
  EXPECT_FALSE(wall_at(0.0, 0.56F));
}

TEST(ObstacleGuard, TheFootprintMeetsWhatLiesInTheWayOfTheDiscAndNothingElse) {
  RangeScan scan = full_circle(0.0F, 720);
  ObstacleGuardParams params;
  params.type = "footprint";
  params.radius_m = 0.2;
  const auto clear_with = [&](Point2 p_robot) {  // one point in sight
    RangeScan seen = scan;
    seen.range_min_m = 0.05;
    const Point2 p = inverse(seen.T_robot_sensor) * p_robot;
    const double step = seen.angle_increment_rad;
    const auto beam = static_cast<std::size_t>(
        std::lround((wrap_angle(std::atan2(p.y, p.x)) - seen.angle_min_rad) / step));
    seen.ranges_m.at(beam % seen.ranges_m.size()) = static_cast<float>(norm(p));
    return clear_ahead_m(seen, LocalOccupancy{3, 0.4}, params);
  };
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Pose2& mount : {Pose2{}, Pose2{0.1, -0.05, 2.0}}) {
    SCOPED_TRACE(mount.yaw);
    scan.T_robot_sensor = mount;
    EXPECT_NEAR(clear_with({0.5, 0.0}), 0.3, 0.005);
    EXPECT_NEAR(clear_with({0.5, 0.12}), 0.5 - 0.16, 0.01) << "a door post touches aside";
    EXPECT_EQ(clear_with({0.5, 0.22}), infinity) << "it is passed";
    EXPECT_EQ(clear_with({0.5, -0.22}), infinity);
    EXPECT_EQ(clear_with({-0.3, 0.0}), infinity) << "it lies behind";
    EXPECT_EQ(clear_with({0.18, 0.02}), 0.0) << "it touches";
  }
  params.type = "none";
  EXPECT_EQ(clear_with({0.3, 0.0}), infinity);
}

}  // namespace
}  // namespace cmn
