// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
// In a world that is a map with walls, the 3D simulator is the planar one.
#include "coarse_map_nav/evaluation/house_generator.hpp"
#include "coarse_map_nav/scene/extrusion.hpp"
#include "coarse_map_nav/scene/ray_cast_sensors.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <cmath>

#include "scenes.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

LidarParams faultless() {
  LidarParams params;
  params.noise_m = 0.0;
  params.noise_share = 0.0;
  params.dropout = 0.0;
  params.range_min_m = 0.0;
  return params;
}

SensorMounts mounts_at(double height_m) {
  SensorMounts mounts;
  mounts.T_robot_lidar.translation().z() = height_m;
  mounts.T_robot_depth = looking_ahead(0.0, 0.0, height_m);
  mounts.T_robot_color = mounts.T_robot_depth;
  return mounts;
}

TEST(SceneProperty, ALidarInAnExtrudedMapSeesWhatTheMapHolds) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const CoarseMap map = occupancy(generate_house(seed), 0.05);
    const World world{map};
    RayCastSensorParams params;
    params.lidar = faultless();
    RayCastSensors sensors{caster_of(extrude(map)), params, mounts_at(0.2), seed};
    RangeSensor planar{params.lidar, seed};
    std::mt19937 rng{seed};
    int different = 0;
    for (int look = 0; look < 10; ++look) {
      const Pose2 at = world.random_free_pose(0.2, rng, 1.0).value();
      const RangeScan in_space = sensors.scan(at, 0.0);
      const RangeScan in_plane = planar.measure(world, at, 0.0);
      ASSERT_EQ(in_space.ranges_m.size(), in_plane.ranges_m.size());
      for (std::size_t i = 0; i < in_plane.ranges_m.size(); ++i) {
        const float a = in_space.ranges_m[i];
        const float b = in_plane.ranges_m[i];
        different += !(a == b || std::abs(a - b) < 1e-3F);
      }
    }
    // A beam that grazes a corner may pass it here and not there.
    EXPECT_LE(different, 3) << "of 3600 beams";
  }
}

TEST(SceneProperty, LookingWithOneSensorLeavesTheOthersAlone) {
  const CoarseMap map = occupancy(generate_house(1), 0.05);
  const std::shared_ptr<const RayCaster> caster = caster_of(extrude(map));
  std::mt19937 rng{1};
  const Pose2 at = World{map}.random_free_pose(0.2, rng).value();
  RayCastSensors alone{caster, {}, mounts_at(0.2), 5};
  RayCastSensors busy{caster, {}, mounts_at(0.2), 5};
  busy.depth(at, 0.0);
  busy.color(at, 0.0);
  EXPECT_EQ(alone.scan(at, 0.0).ranges_m, busy.scan(at, 0.0).ranges_m);
}

TEST(SceneProperty, MountsMoveWhatIsSeen) {
  const CoarseMap map = occupancy(generate_house(2), 0.05);
  std::mt19937 rng{2};
  const Pose2 at = World{map}.random_free_pose(0.4, rng).value();
  RayCastSensorParams params;
  params.lidar = faultless();
  SensorMounts moved = mounts_at(0.2);
  moved.T_robot_lidar = in_space({0.1, -0.05, 0.3}) * moved.T_robot_lidar;
  const std::shared_ptr<const RayCaster> caster = caster_of(extrude(map));
  RayCastSensors robot{caster, params, moved, 1};
  RayCastSensors there{caster, params, mounts_at(0.2), 1};
  const RangeScan scan = robot.scan(at, 0.0);
  EXPECT_EQ(scan.ranges_m, there.scan(at * Pose2{0.1, -0.05, 0.3}, 0.0).ranges_m);
  EXPECT_NEAR(scan.T_robot_sensor.x, 0.1, 1e-12);
  EXPECT_NEAR(scan.T_robot_sensor.yaw, 0.3, 1e-12);
}

}  // namespace
}  // namespace cmn
