// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How long the robot takes for an action.
#pragma once

#include "coarse_map_nav/data/action.hpp"
#include "coarse_map_nav/motion/motion_params.hpp"
#include "coarse_map_nav/simulation/robot_model.hpp"

#include <map>
#include <utility>

namespace cmn {

/// The times of actions by StepDrive, which knows none: what MotionController takes for them with
/// the simulated base on open ground, without slip and noise, from rest to rest. Looking and
/// thinking take no time, and a step that a wall ends takes as long as a whole one.
class ActionTimes {
 public:
  ActionTimes(const RobotParams& robot, const MotionParams& motion);
  double of(const Action& action);

 private:
  RobotParams robot_;
  MotionParams motion_;
  std::map<std::pair<ActionType, double>, double> known_s_;  ///< by type and distance
};

}  // namespace cmn
