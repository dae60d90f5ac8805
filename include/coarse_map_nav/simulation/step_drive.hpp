// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A base that carries out one action at a time, at once.
#pragma once

#include "coarse_map_nav/data/action.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/simulation/robot_model.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <cstdint>
#include <random>

namespace cmn {

/// What Simulator and MotionController make of an action, without the time that it takes: the same
/// slip, noise and drift, drawn once for a whole action from the same RobotParams. For thousands of
/// episodes: an action costs microseconds instead of milliseconds. A test holds the spread of its
/// errors against the full simulation.
///
/// As on the robot a turn ends on the next axis of the odometry (Robb), a step forward runs along
/// the heading and ends short at an obstacle: a collision, kBlocked. With RobotParams::sliding it
/// goes on along the obstacle and is blocked only where that takes it less than half the way ahead.
class StepDrive {
 public:
  /// The odometry frame is the start pose. Throws std::invalid_argument inside an obstacle.
  StepDrive(const World& world, const RobotParams& params, const Pose2& T_world_start,
            std::uint64_t seed);

  MotionOutcome carry_out(const Action& action);
  /// Kidnaps the robot; odometry does not notice. Throws as the constructor does.
  void set_truth(const Pose2& T_world_robot);

  const Pose2& truth() const { return T_world_robot_; }
  const Pose2& T_odom_robot() const { return T_odom_robot_; }
  double driven_m() const { return driven_m_; }
  int collisions() const { return collisions_; }

 private:
  MotionOutcome forward(double distance_m, double axes_yaw_rad);
  /// Turns onto the axis that lies so many quarter turns from the nearest one.
  void hold_axis(int quarter_turns, double axes_yaw_rad);

  const World& world_;
  RobotParams params_;
  std::mt19937_64 rng_;
  double travel_bias_;
  double turn_bias_;
  Pose2 T_world_robot_;
  Pose2 T_odom_robot_;
  double driven_m_ = 0.0;
  int collisions_ = 0;
};

}  // namespace cmn
