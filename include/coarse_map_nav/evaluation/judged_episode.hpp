// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One episode under the eyes of the judge.
#pragma once

#include "coarse_map_nav/evaluation/drawing.hpp"
#include "coarse_map_nav/evaluation/episode_row.hpp"
#include "coarse_map_nav/evaluation/judge.hpp"
#include "coarse_map_nav/evaluation/method.hpp"
#include "coarse_map_nav/evaluation/route_sampler.hpp"
#include "coarse_map_nav/evaluation/task.hpp"
#include "coarse_map_nav/perception/occupancy_predictor.hpp"
#include "coarse_map_nav/simulation/scene_sensors.hpp"
#include "coarse_map_nav/simulation/simulator.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace cmn {

class Navigator;

/// Puts a robot's sensors into a world with heights. Called by several threads at once.
using SensorMaker =
    std::function<std::unique_ptr<SceneSensors>(const LidarParams& lidar, std::uint32_t seed)>;

/// A world that episodes are played in, made ready once.
struct Scene {
  Scene(std::string scene_name, CoarseMap world_map, std::optional<CoarseMap> wall_map,
        const JudgeParams& judge);

  std::string name;
  CoarseMap map;                   ///< what stops the robot, and is drawn
  std::optional<CoarseMap> walls;  ///< of a generated house
  World world;
  RouteSampler routes;
  CoarseMap drivable;  ///< where the middle of the robot can be: what the oracle plans on
  std::optional<Drawing> drawing;  ///< given, in place of those that the tasks make
  SensorMaker sensors;             ///< of a world with heights; empty: a LiDAR in the plane
};

/// The start and goal of an episode whose goal is free on the drawing, or none.
std::optional<Route> sample_route(const Scene& scene, const Drawing& drawing,
                                  const JudgeParams& judge, std::uint64_t seed);

/// What a recorder may look at before each action is carried out; pivots are none.
struct EpisodeMoment {
  Pose2 T_world_robot;
  Localization localization;
  Pose2 T_map_true;
  Pose2 T_map_estimate;
  Pose2 T_world_estimate;  ///< where the estimate lies in truth
  int collisions;          ///< so far
  const CoarseMap& map;    ///< that the method was given
  Point2 goal_map;         ///< on it [m]
  const Decision& decision;
  const LocalOccupancy& local_map;
  const LocalOccupancy& seen;  ///< by the localizer
  Pose2 T_odom_robot;
  const Navigator& navigator;  ///< that decided
};
using EpisodeRecorder = std::function<void(const EpisodeMoment&)>;

/// Runs a method until it declares an end, the horizon of its parameters is over or, where the
/// judge ends episodes, success. Deterministic but for step_ms. `clock_s` times the steps;
/// `predictor` is of methods that look in colour.
EpisodeRow run_judged_episode(const Scene& scene, const Task& task, const Drawing& drawing,
                              const Route& route, const Method& method, NavigatorParams params,
                              const JudgeParams& judge, const EpisodeKey& key,
                              const std::function<double()>& clock_s,
                              const EpisodeRecorder& recorder = {},
                              std::shared_ptr<OccupancyPredictor> predictor = nullptr);

}  // namespace cmn
