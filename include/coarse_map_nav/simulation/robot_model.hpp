// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A differential drive that slips, drifts and bumps into things.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/odometry.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <cstdint>
#include <deque>
#include <random>

namespace cmn {

/// A Kobuki-like base. Every default is a plausible figure of ours, not from a paper.
///
/// Random errors grow with the square root of the way, as sums of independent ones do: 0.015 is
/// 1.5 % of the first metre and 3.9 % of a step of 0.15 m; 0.0125 is 1 % of a quarter turn. Biases
/// are standard deviations of errors that are drawn once for a robot (a seed) and then stay.
struct RobotParams {
  double radius_m = 0.18;
  double wheel_base_m = 0.23;
  double max_linear_mps = 0.7;
  double max_angular_radps = 3.1;
  double linear_acceleration = 1.0;
  double angular_acceleration = 4.0;
  double command_delay_s = 0.05;
  double travel_noise = 0.015;
  double wheel_slip = 0.003;
  double turn_noise = 0.0125;
  double travel_bias = 0.003;
  double turn_bias = 0.003;
  bool gyro = true;
  bool sliding = false;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("radius_m", self.radius_m, Between{0.02, 2.0}, "[m] of the disc that is the robot");
    visit("wheel_base_m", self.wheel_base_m, Between{0.02, 2.0}, "[m] between the wheels");
    visit("max_linear_mps", self.max_linear_mps, Between{0.01, 5.0}, "[m/s] what the base can do");
    visit("max_angular_radps", self.max_angular_radps, Between{0.01, 20.0},
          "[rad/s] what the base can do");
    visit("linear_acceleration", self.linear_acceleration, Between{0.01, 50.0},
          "[m/s^2] what the base can do");
    visit("angular_acceleration", self.angular_acceleration, Between{0.01, 200.0},
          "[rad/s^2] what the base can do");
    visit("command_delay_s", self.command_delay_s, Between{0.0, 1.0},
          "[s] from a command to the base's acting on it");
    visit("travel_noise", self.travel_noise, Between{0.0, 0.5},
          "[m/sqrt(m)] random error of the way driven, both wheels alike");
    visit("wheel_slip", self.wheel_slip, Between{0.0, 0.1},
          "[m/sqrt(m)] random error of the way of each wheel by itself: the robot veers");
    visit("turn_noise", self.turn_noise, Between{0.0, 0.5},
          "[rad/sqrt(rad)] random error of the turn that odometry counts");
    visit("travel_bias", self.travel_bias, Between{0.0, 0.2},
          "[-] standard deviation of the lasting error of each wheel's way");
    visit("turn_bias", self.turn_bias, Between{0.0, 0.2},
          "[-] standard deviation of the gyro's lasting scale error");
    visit("gyro", self.gyro, Anything{},
          "odometry takes its heading from a gyro, as the Kobuki does; false: from the wheels");
    visit("sliding", self.sliding, Anything{},
          "slide along walls instead of stopping, as in the simulator of CMN's released runs");
  }
};

/// The base at one instant, and what it has been through.
struct RobotState {
  Pose2 T_world_robot;       ///< the truth
  Pose2 T_odom_robot;        ///< what odometry says; identity where the robot woke up
  VelocityCommand velocity;  ///< that the wheels run at
  bool bumped = false;       ///< pressed by a collision until the robot moves or turns away
  double driven_m = 0.0;     ///< length of the true path
  int collisions = 0;        ///< number of times that `bumped` came on
};

/// How far a disc came.
struct Passage {
  bool collided = false;
  Point2 way;  ///< really gone
};
/// Moves the robot's disc a short way (less than its radius) through the world: to the contact, and
/// on along the wall where `params.sliding`.
Passage pass(const World& world, Point2 from, Point2 way, const RobotParams& params);

/// Integrates a RobotState under velocity commands.
///
/// Wheels follow the command within the acceleration limits. Each wheel's true way differs from the
/// way that odometry counts by slip. The robot is a disc that turns freely but never enters an
/// obstacle: it stops at the contact and its wheels stall there, so that odometry does not count
/// on.
class RobotModel {
 public:
  RobotModel(const RobotParams& params, const Pose2& T_world_start, std::uint32_t seed);

  /// One step of at most a few milliseconds, up to `time_s`. A command that is not finite is zero.
  void step(const World& world, double time_s, double dt_s, VelocityCommand command);
  const RobotState& state() const { return state_; }
  /// Puts the robot elsewhere, at rest; odometry does not notice.
  void set_truth(const Pose2& T_world_robot);

 private:
  struct TimedCommand {
    double time_s;
    VelocityCommand command;
  };
  VelocityCommand delayed(double time_s, VelocityCommand command);
  void press_bumper(bool collided);
  double gaussian() { return normal_(rng_); }

  RobotParams params_;
  RobotState state_;
  std::mt19937 rng_;
  std::normal_distribution<double> normal_;
  double left_bias_;
  double right_bias_;
  double turn_bias_;
  Pose2 T_world_contact_;  ///< where the bumper was pressed
  VelocityCommand acting_;
  std::deque<TimedCommand> under_way_;
};

}  // namespace cmn
