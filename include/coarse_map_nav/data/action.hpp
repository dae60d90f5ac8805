// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the planner orders and what became of it.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <cstdint>

namespace cmn {

/// CMN's action space and the order to stay; values as in msg/DiscreteAction.
enum class ActionType : std::uint8_t { kStop = 0, kMoveForward, kTurnLeft, kTurnRight };

/// CMN sec. V-A: "move_forward advances the robot by 0.15 m".
constexpr double kCmnStep_m = 0.15;

struct Action {
  ActionType type = ActionType::kStop;
  double distance_m = 0.0;  ///< of kMoveForward
  /// Yaw, in the frame of the odometry, of the axes that the robot keeps to; 0: the odometry's own.
  double axes_yaw_rad = 0.0;
};

/// The heading an action leaves a robot with.
constexpr int quarter_turns(ActionType type) {
  return type == ActionType::kTurnLeft ? 1 : type == ActionType::kTurnRight ? -1 : 0;
}

/// How an action ended; values as in msg/MotionResult.
enum class MotionOutcome : std::uint8_t { kSucceeded = 0, kBlocked, kTimedOut, kPreempted };

struct MotionResult {
  std::uint32_t action_id = 0;
  MotionOutcome outcome = MotionOutcome::kSucceeded;
  Pose2 T_start_end;  ///< what odometry says was driven, in the frame of the start pose
};

}  // namespace cmn
