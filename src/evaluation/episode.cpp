// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/episode.hpp"

#include "coarse_map_nav/evaluation/looks.hpp"
#include "coarse_map_nav/motion/motion_controller.hpp"

#include <functional>
#include <optional>

namespace cmn {
namespace {

constexpr double kOdometryPeriod_s = 0.02;
constexpr int kScanPeriod = 5;  ///< in odometry periods

/// What the robot sees at this instant; valid until the next.
using Look = std::function<SensorData()>;

/// Carries one action out, the guard watching at scan rate as on the robot.
MotionOutcome carry_out(const Action& action, std::uint32_t id, const Look& look,
                        Navigator& navigator, Simulator& simulator, MotionController& controller) {
  double clear_m = navigator.clear_ahead_m();
  controller.start(id, action, simulator.odometry());
  for (int tick = 1;; ++tick) {
    if (tick % kScanPeriod == 0) {
      clear_m = navigator.clear_ahead_m(look());
    }
    const MotionStep step = controller.step(simulator.odometry(), clear_m, simulator.bumped());
    if (step.result) {
      return step.result->outcome;
    }
    simulator.advance(kOdometryPeriod_s, step.command);
  }
}

}  // namespace

EpisodeResult run_episode(const World& world, const SimulationParams& simulation,
                          const CoarseMap& map, const NavigatorParams& params,
                          const EpisodeTask& task, std::uint32_t seed, SceneSensors* sensors) {
  Simulator simulator{world, simulation, task.T_world_start, seed};
  RangeScan scan;
  std::optional<Looks> looks;
  if (sensors != nullptr) {
    looks.emplace(*sensors, params.perception);
  }
  const Look look = [&] {
    if (looks) {
      return looks->at(simulator.truth(), simulator.time_s());
    }
    scan = simulator.scan();
    return SensorData{&scan};
  };
  Navigator navigator{map, params};
  MotionController controller{params.motion};
  EpisodeResult result;
  if (const auto reason = navigator.planner().set_goal(task.goal_map)) {
    result.reason = *reason;
    return result;
  }
  MotionOutcome last_outcome = MotionOutcome::kSucceeded;
  for (std::uint32_t id = 1;; ++id) {
    EpisodeStep step;
    step.T_world_robot = simulator.truth();
    step.decision = navigator.step(look(), simulator.odometry().T_odom_robot, last_outcome);
    const Localization at = navigator.localizer().localization();
    step.estimate = at.estimate;
    step.confidence = at.confidence;
    step.was_blocked = navigator.is_blocked_ahead();
    const bool is_over = step.decision.state == NavigationState::kReached ||
                         step.decision.state == NavigationState::kFailed;
    if (!is_over) {
      step.outcome = carry_out(step.decision.action, id, look, navigator, simulator, controller);
      last_outcome = step.outcome;
    }
    result.steps.push_back(step);
    if (is_over) {
      break;
    }
  }
  result.end = result.steps.back().decision.state;
  result.reason = result.steps.back().decision.text;
  result.T_world_end = simulator.truth();
  result.time_s = simulator.time_s();
  result.driven_m = simulator.driven_m();
  result.collisions = simulator.collisions();
  return result;
}

}  // namespace cmn
