// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/simulated_robot.hpp"

#include "coarse_map_nav/scene/extrusion.hpp"
#include "coarse_map_nav/scene/slice.hpp"

#include <stdexcept>

#include "ascii_map.hpp"
#include "scenes.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

SensorMounts mounts() {
  SensorMounts made;
  made.T_robot_lidar.translation().z() = 0.4;
  made.T_robot_depth = looking_ahead(0.0, 0.0, 0.5);
  made.T_robot_color = made.T_robot_depth;
  return made;
}

/// A room with a low box ahead of (1, 2.5) that a LiDAR at 0.4 m looks over.
SceneWorld room_with_a_low_box() {
  MeshScene scene = box_room();
  add_box(scene, {2, 1, 0}, {2.5F, 4, 0.3F}, 0);
  SceneWorld world;
  world.body = slice(scene, {});
  world.scene = std::make_shared<const MeshScene>(scene);
  return world;
}

TEST(SimulatedRobot, ItsLidarLooksOverWhatItsBodyBumpsInto) {
  SimulatedRobot robot{room_with_a_low_box(), {}, mounts(), {1.0, 2.5, 0.0}, 1};
  const RangeScan scan = robot.scan();
  EXPECT_NEAR(scan.ranges_m[scan.ranges_m.size() / 2], 3.0, 0.15) << "the wall behind the box";
  for (int i = 0; i < 100; ++i) {
    robot.simulator().advance(0.1, {0.3, 0.0});
  }
  EXPECT_TRUE(robot.simulator().bumped());
  EXPECT_NEAR(robot.simulator().truth().x, 2.0 - 0.18, 0.02);
}

TEST(SimulatedRobot, InAMapItsScansAreThoseOfThePlanarSimulator) {
  SceneWorld world;
  world.is_map = true;
  world.body = ascii_map({"#######", "#.....#", "#.....#", "#...#.#", "#######"}, 0.5);
  world.scene = std::make_shared<const MeshScene>(extrude(world.body));
  const Pose2 start{1.25, 1.25, 0.0};
  SimulatedRobot robot{world, {}, mounts(), start, 7};
  Simulator planar{World{world.body}, {}, start, 7};
  EXPECT_EQ(robot.scan().ranges_m, planar.scan().ranges_m);
  ASSERT_NE(robot.cameras(), nullptr);
  EXPECT_EQ(robot.why_no_cameras(), "");
  const DepthImage depth = robot.cameras()->depth(start, 0.0);
  EXPECT_NEAR(depth.depth_m.at<float>(120, 160), 1.75F, 0.05F) << "the walls of the map";
}

TEST(SimulatedRobot, DoesNotStartInsideThings) {
  EXPECT_THROW((SimulatedRobot{room_with_a_low_box(), {}, mounts(), {2.2, 2.5, 0.0}, 1}),
               std::invalid_argument);
}

}  // namespace
}  // namespace cmn
