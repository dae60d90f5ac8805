// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/simulation/robot_model.hpp"

#include "coarse_map_nav/motion/velocity_profile.hpp"

#include <algorithm>
#include <cmath>

namespace cmn {
namespace {

/// The contact is found to 1/1024 of a step of a few millimetres.
constexpr int kHalvings = 10;
/// The bumper lets go once the robot has moved or turned by so much from where it was pressed.
constexpr double kRelease_m = 0.005;
constexpr double kRelease_rad = 0.35;

VelocityCommand finite_or_zero(const VelocityCommand& command) {
  return std::isfinite(command.linear_mps) && std::isfinite(command.angular_radps)
             ? command
             : VelocityCommand{};
}

/// The share of `way` that a disc can go before it meets an obstacle.
double free_share(const World& world, Point2 from, Point2 way, double radius_m) {
  if (world.is_disc_free(from + way, radius_m)) {
    return 1.0;
  }
  double free = 0.0;
  double blocked = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (free + blocked) / 2.0;
    (world.is_disc_free(from + middle * way, radius_m) ? free : blocked) = middle;
  }
  return free;
}

}  // namespace

Passage pass(const World& world, Point2 from, Point2 way, const RobotParams& params) {
  const double share = free_share(world, from, way, params.radius_m);
  Point2 moved = share * way;
  if (share < 1.0 && params.sliding) {
    // What is left of the way goes on along the wall: its part towards the contact is taken out.
    const Point2 at = from + moved;
    const double reach_m = params.radius_m + norm(way);
    if (const auto contact = world.nearest_obstacle(at, reach_m)) {
      const Point2 out = at - *contact;
      const Point2 rest = (1.0 - share) * way;
      const double square = out.x * out.x + out.y * out.y;
      const double inward = square > 0.0 ? (rest.x * out.x + rest.y * out.y) / square : 0.0;
      const Point2 along = rest - inward * out;
      moved = moved + free_share(world, at, along, params.radius_m) * along;
    }
  }
  return {share < 1.0, moved};
}

RobotModel::RobotModel(const RobotParams& params, const Pose2& T_world_start, std::uint32_t seed)
    : params_{params}, rng_{seed} {
  state_.T_world_robot = T_world_start;
  left_bias_ = params.travel_bias * gaussian();
  right_bias_ = params.travel_bias * gaussian();
  turn_bias_ = params.turn_bias * gaussian();
}

void RobotModel::set_truth(const Pose2& T_world_robot) {
  state_.T_world_robot = T_world_robot;
  state_.velocity = {};
  state_.bumped = false;
}

VelocityCommand RobotModel::delayed(double time_s, VelocityCommand command) {
  under_way_.push_back({time_s + params_.command_delay_s, command});
  while (!under_way_.empty() && under_way_.front().time_s <= time_s) {
    acting_ = under_way_.front().command;
    under_way_.pop_front();
  }
  return acting_;
}

void RobotModel::press_bumper(bool collided) {
  const Pose2& here = state_.T_world_robot;
  if (collided) {
    state_.collisions += !state_.bumped;
    state_.bumped = true;
    T_world_contact_ = here;
  } else if (state_.bumped &&
             (norm(here.position() - T_world_contact_.position()) > kRelease_m ||
              std::abs(wrap_angle(here.yaw - T_world_contact_.yaw)) > kRelease_rad)) {
    state_.bumped = false;
  }
}

void RobotModel::step(const World& world, double time_s, double dt_s, VelocityCommand command) {
  const VelocityCommand told = delayed(time_s, finite_or_zero(command));
  VelocityCommand& now = state_.velocity;
  now.linear_mps = ramped(
      now.linear_mps, std::clamp(told.linear_mps, -params_.max_linear_mps, params_.max_linear_mps),
      params_.linear_acceleration, dt_s);
  now.angular_radps =
      ramped(now.angular_radps,
             std::clamp(told.angular_radps, -params_.max_angular_radps, params_.max_angular_radps),
             params_.angular_acceleration, dt_s);
  if (now.linear_mps == 0.0 && now.angular_radps == 0.0) {
    return;
  }

  // What the wheels count, and what the floor makes of it.
  const double counted_way = now.linear_mps * dt_s;
  const double counted_turn = now.angular_radps * dt_s;
  const double counted_left = counted_way - counted_turn * params_.wheel_base_m / 2.0;
  const double counted_right = counted_way + counted_turn * params_.wheel_base_m / 2.0;
  const double shared_error = params_.travel_noise * std::sqrt(std::abs(counted_way)) * gaussian();
  const auto slipped = [&](double counted, double bias) {
    return counted * (1.0 + bias) + shared_error +
           params_.wheel_slip * std::sqrt(std::abs(counted)) * gaussian();
  };
  const double left = slipped(counted_left, left_bias_);
  const double right = slipped(counted_right, right_bias_);
  const double way = (left + right) / 2.0;
  const double turn = (right - left) / params_.wheel_base_m;

  const double course = state_.T_world_robot.yaw + turn / 2.0;
  const Point2 ahead{std::cos(course), std::sin(course)};
  const auto [collided, moved] = pass(world, state_.T_world_robot.position(), way * ahead, params_);
  state_.T_world_robot.x += moved.x;
  state_.T_world_robot.y += moved.y;
  state_.T_world_robot.yaw = wrap_angle(state_.T_world_robot.yaw + turn);
  state_.driven_m += norm(moved);
  // A pivot beside a wall may slip against it; only wheels that drive collide.
  press_bumper(collided && counted_way != 0.0);
  if (collided && !params_.sliding) {
    now.linear_mps = 0.0;
  }
  const double moved_share = way == 0.0 ? 1.0 : (moved.x * ahead.x + moved.y * ahead.y) / way;

  const double gyro_turn = turn * (1.0 + turn_bias_) +
                           params_.turn_noise * std::sqrt(std::abs(counted_turn)) * gaussian();
  const double odom_turn = params_.gyro ? gyro_turn : counted_turn;
  Pose2& odom = state_.T_odom_robot;
  const Point2 step = turned(Point2{counted_way * moved_share, 0.0}, odom.yaw + odom_turn / 2.0);
  odom = {odom.x + step.x, odom.y + step.y, wrap_angle(odom.yaw + odom_turn)};
}

}  // namespace cmn
