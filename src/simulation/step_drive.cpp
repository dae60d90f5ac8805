// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/simulation/step_drive.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace cmn {
namespace {

// What is left of an action when the controllers call it done (as measured on the simulated base).
constexpr double kStopError_m = 0.003;
constexpr double kAlignError_rad = 0.003;

constexpr double kPiece_m = 0.01;

/// A robot that slides is blocked when it gets less than this share of its way ahead.
constexpr double kSlidAlong = 0.5;

}  // namespace

StepDrive::StepDrive(const World& world, const RobotParams& params, const Pose2& T_world_start,
                     std::uint64_t seed)
    : world_{world}, params_{params}, rng_{seed} {
  // Two wheels with a bias each: their mean.
  travel_bias_ = params.travel_bias * draw_normal(rng_) / std::sqrt(2.0);
  turn_bias_ = params.turn_bias * draw_normal(rng_);
  set_truth(T_world_start);
}

void StepDrive::set_truth(const Pose2& T_world_robot) {
  if (!world_.is_disc_free(T_world_robot.position(), params_.radius_m)) {
    throw std::invalid_argument("the robot would stand inside an obstacle");
  }
  T_world_robot_ = T_world_robot;
}

MotionOutcome StepDrive::carry_out(const Action& action) {
  if (action.type == ActionType::kMoveForward) {
    return forward(action.distance_m, action.axes_yaw_rad);
  }
  if (action.type != ActionType::kStop) {
    hold_axis(quarter_turns(action.type), action.axes_yaw_rad);
  }
  return MotionOutcome::kSucceeded;
}

MotionOutcome StepDrive::forward(double distance_m, double axes_yaw_rad) {
  const double counted_m = distance_m + kStopError_m * draw_normal(rng_);
  const double true_m =
      std::max(0.0, counted_m * (1.0 + travel_bias_) +
                        params_.travel_noise * std::sqrt(distance_m) * draw_normal(rng_));
  const Point2 ahead = turned(Point2{1.0, 0.0}, T_world_robot_.yaw);
  const int pieces = std::max(1, static_cast<int>(std::ceil(true_m / kPiece_m)));
  bool has_collided = false;
  Point2 gone;
  for (int i = 0; i < pieces && (!has_collided || params_.sliding); ++i) {
    const Passage passage =
        pass(world_, T_world_robot_.position() + gone, (true_m / pieces) * ahead, params_);
    gone = gone + passage.way;
    has_collided |= passage.collided;
    driven_m_ += norm(passage.way);
  }
  T_world_robot_.x += gone.x;
  T_world_robot_.y += gone.y;
  collisions_ += has_collided;
  // The wheels stall at the contact: odometry counts the way really gone.
  const double share = true_m > 0.0 ? (gone.x * ahead.x + gone.y * ahead.y) / true_m : 1.0;
  const Point2 counted = turned(Point2{share * counted_m, 0.0}, T_odom_robot_.yaw);
  T_odom_robot_.x += counted.x;
  T_odom_robot_.y += counted.y;
  hold_axis(0, axes_yaw_rad);
  const bool is_blocked = has_collided && !(params_.sliding && share >= kSlidAlong);
  return is_blocked ? MotionOutcome::kBlocked : MotionOutcome::kSucceeded;
}

void StepDrive::hold_axis(int quarter_turns, double axes_yaw_rad) {
  const double axis_rad =
      axes_yaw_rad + yaw(turned(nearest_heading(T_odom_robot_.yaw - axes_yaw_rad), quarter_turns));
  const double counted =
      wrap_angle(axis_rad + kAlignError_rad * draw_normal(rng_) - T_odom_robot_.yaw);
  const double error = params_.turn_noise * std::sqrt(std::abs(counted)) * draw_normal(rng_);
  T_odom_robot_.yaw = wrap_angle(T_odom_robot_.yaw + counted);
  T_world_robot_.yaw = wrap_angle(T_world_robot_.yaw + (counted - error) / (1.0 + turn_bias_));
}

}  // namespace cmn
