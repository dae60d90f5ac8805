// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// Judged episodes in a furnished house, seen with a depth or colour camera.
#include "coarse_map_nav/evaluation/action_times.hpp"
#include "coarse_map_nav/evaluation/judged_episode.hpp"
#include "coarse_map_nav/scene/ray_cast_sensors.hpp"
#include "coarse_map_nav/scene/scene_world.hpp"
#include "coarse_map_nav/simulation/robot_description.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "fake_predictor.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

const std::string kSource = CMN_SOURCE_DIR;

/// house:7 with boxes for furniture, and a camera of few pixels in it.
Scene furnished_house(const JudgeParams& judge) {
  SceneWorldParams params;
  params.furniture_folder.clear();
  params.robot_height_m = judge.robot_height_m;
  const SceneWorld world = open_scene_world("house:7", params);
  Scene scene{"house", world.body, std::nullopt, judge};
  const std::shared_ptr<const RayCaster> caster = make_ray_caster(world.scene);
  const RobotDescription robot = read_robot_description(kSource + "/urdf/locobot.urdf");
  const SensorMounts mounts = mounts_of(robot, robot.root, {});
  scene.sensors = [caster, mounts](const LidarParams& lidar, std::uint32_t seed) {
    RayCastSensorParams sensors;
    sensors.lidar = lidar;
    sensors.depth.width = 80;
    sensors.depth.height = 60;
    return std::make_unique<RayCastSensors>(caster, sensors, mounts, seed);
  };
  return scene;
}

EpisodeRow played(const Scene& scene, const JudgeParams& judge, const std::string& task_name,
                  const std::string& method_name, int max_actions,
                  std::shared_ptr<OccupancyPredictor> predictor = nullptr) {
  const Task& task = find_task(task_name);
  const Method& method = find_method(method_name);
  NavigatorParams params = method_params(method, task, kSource + "/config");
  params.planning.max_actions = max_actions;
  const std::uint64_t seed = 5;
  const Drawing drawing = draw(task, scene.map, nullptr, 0.4, 1, judge.simulation.robot.radius_m);
  const std::optional<Route> route = sample_route(scene, drawing, judge, seed);
  EXPECT_TRUE(route);
  return run_judged_episode(
      scene, task, drawing, *route, method, params, judge,
      {task_name, scene.name, 0.4, method_name, 0, seed}, [] { return 0.0; }, {},
      std::move(predictor));
}

TEST(JudgedDepth, PivotsAreCountedApartFromActionsAndTakeTime) {
  const JudgeParams judge;
  const Scene scene = furnished_house(judge);
  const EpisodeRow row = played(scene, judge, "CD", "true_pose", 12);
  EXPECT_EQ(row.actions, 12);
  EXPECT_GE(row.pivots, 8) << "at two stops at least";
  EXPECT_EQ(row.pivots % 4, 0);
  ActionTimes times{judge.simulation.robot, MotionParams{}};
  const double turn_s = times.of({ActionType::kTurnLeft});
  const double step_s = times.of({ActionType::kMoveForward, 0.15});
  EXPECT_GE(row.simulated_s, row.pivots * turn_s + row.actions * step_s - 1e-9);
  EXPECT_LE(row.simulated_s, (row.pivots + row.actions) * turn_s + 1e-9);
  EXPECT_GT(row.free_iou, 0.5);
  EXPECT_GT(row.obstacle_iou, 0.3);
}

TEST(JudgedDepth, ARobotThatLooksForwardNeedsNoPivots) {
  const JudgeParams judge;
  const Scene scene = furnished_house(judge);
  const EpisodeRow row = played(scene, judge, "CF", "depth_rolling", 500);
  EXPECT_TRUE(row.is_success) << row.end;
  EXPECT_EQ(row.pivots, 0);
  EXPECT_EQ(row.confidence.looks(), row.actions + 1);
}

TEST(JudgedDepth, ARobotThatTurnsRoundAtEveryStopArrives) {
  const JudgeParams judge;
  const Scene scene = furnished_house(judge);
  const EpisodeRow row = played(scene, judge, "CD", "ours", 500);
  EXPECT_TRUE(row.is_success) << row.end;
  EXPECT_EQ(row.confidence.looks(), row.actions + 1) << "a panorama is one look";
}

TEST(JudgedDepth, TheSameSeedGivesTheSameRow) {
  const JudgeParams judge;
  const Scene scene = furnished_house(judge);
  for (const std::string method : {"fused", "depth_rolling", "rolling"}) {
    EXPECT_EQ(csv_line(played(scene, judge, "CF", method, 10)),
              csv_line(played(scene, judge, "CF", method, 10)))
        << method;
  }
}

TEST(JudgedColor, FourViewsAreOnePredictionAStop) {
  const JudgeParams judge;
  const Scene scene = furnished_house(judge);
  const auto predictor = std::make_shared<FakePredictor>();
  const EpisodeRow row = played(scene, judge, "CI", "cmn", 6, predictor);
  EXPECT_EQ(row.actions, 6);
  EXPECT_GE(row.pivots, 8);
  // Once a stop, and once for each turn on the spot, which needs no new panorama.
  EXPECT_EQ(predictor->predictions, row.confidence.looks());
  EXPECT_EQ(csv_line(row),
            csv_line(played(scene, judge, "CI", "cmn", 6, std::make_shared<FakePredictor>())));
}

}  // namespace
}  // namespace cmn
