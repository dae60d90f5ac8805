// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/action_times.hpp"

#include "coarse_map_nav/motion/motion_controller.hpp"
#include "coarse_map_nav/simulation/simulator.hpp"

#include <limits>

namespace cmn {
namespace {

constexpr double kOdometryPeriod_s = 0.02;

double measured_s(const Action& action, const RobotParams& robot, const MotionParams& motion) {
  const double side_m = 2.0 * (action.distance_m + robot.radius_m + 1.0);
  const World open{CoarseMap{Grid<std::uint8_t>{3, 3}, side_m / 3.0}};
  SimulationParams params;
  params.robot = robot;
  Simulator simulator{open, params, {0.5 * side_m, 0.5 * side_m, 0.0}, 0};
  MotionController controller{motion};
  controller.start(1, {action.type, action.distance_m}, simulator.odometry());
  while (true) {
    const MotionStep step =
        controller.step(simulator.odometry(), std::numeric_limits<double>::infinity(), false);
    if (step.result) {
      return simulator.time_s();
    }
    simulator.advance(kOdometryPeriod_s, step.command);
  }
}

}  // namespace

ActionTimes::ActionTimes(const RobotParams& robot, const MotionParams& motion)
    : robot_{robot}, motion_{motion} {
  robot_.travel_noise = robot_.wheel_slip = robot_.turn_noise = 0.0;
  robot_.travel_bias = robot_.turn_bias = 0.0;
}

double ActionTimes::of(const Action& action) {
  if (action.type == ActionType::kStop) {
    return 0.0;
  }
  const auto [known, is_new] = known_s_.emplace(std::pair{action.type, action.distance_m}, 0.0);
  if (is_new) {
    known->second = measured_s(action, robot_, motion_);
  }
  return known->second;
}

}  // namespace cmn
