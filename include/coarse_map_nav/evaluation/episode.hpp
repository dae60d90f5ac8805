// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One journey in process: the same core that the nodes run, in the simulator, without ROS.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/navigator.hpp"
#include "coarse_map_nav/params.hpp"
#include "coarse_map_nav/simulation/scene_sensors.hpp"
#include "coarse_map_nav/simulation/simulator.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cmn {

/// Where a journey begins and ends.
struct EpisodeTask {
  Pose2 T_world_start;
  Point2 goal_map;  ///< as marked on the drawing [m]
};

/// One turn of the loop, as it was decided.
struct EpisodeStep {
  Pose2 T_world_robot;  ///< the truth when the robot looked
  Estimate estimate;
  double confidence = 0.0;
  bool was_blocked = false;
  Decision decision;
  MotionOutcome outcome = MotionOutcome::kSucceeded;
};

struct EpisodeResult {
  std::vector<EpisodeStep> steps;
  NavigationState end = NavigationState::kFailed;
  std::string reason;
  Pose2 T_world_end;
  double time_s = 0.0;    ///< simulated
  double driven_m = 0.0;  ///< true length of the way
  int collisions = 0;
};

/// Runs the robot until the planner declares an end. The noise of the world comes from `seed`, the
/// robot's own choices from the seeds in `params`. A goal that the planner rejects ends at once as
/// kFailed, with its reason. `sensors` are those of a world with heights; null: the simulator's
/// LiDAR.
EpisodeResult run_episode(const World& world, const SimulationParams& simulation,
                          const CoarseMap& map, const NavigatorParams& params,
                          const EpisodeTask& task, std::uint32_t seed,
                          SceneSensors* sensors = nullptr);

}  // namespace cmn
