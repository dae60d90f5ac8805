// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/motion/motion_controller.hpp"

#include "coarse_map_nav/motion/velocity_profile.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace cmn {
namespace {

/// A ramp goes on for at most so long over a gap in the odometry.
constexpr double kLongestPeriod_s = 0.1;
/// An ended action waits at most so long for rest: somebody may be carrying the robot.
constexpr double kLongestStop_s = 2.0;
/// Odometry jumps when it moves by more than this and twice the top speeds since the last sample.
constexpr double kJump_m = 0.1;
constexpr double kJump_rad = 0.3;

double radians(double degrees) { return degrees * kPi / 180.0; }

bool is_zero(const VelocityCommand& command) {
  return command.linear_mps == 0.0 && command.angular_radps == 0.0;
}

}  // namespace

bool is_executable(const Action& action) {
  switch (action.type) {
    case ActionType::kStop:
    case ActionType::kTurnLeft:
    case ActionType::kTurnRight:
      return std::isfinite(action.axes_yaw_rad);
    case ActionType::kMoveForward:
      return std::isfinite(action.axes_yaw_rad) && std::isfinite(action.distance_m) &&
             action.distance_m >= 0.0;
  }
  return false;  // a number from a message that is no action
}

std::optional<MotionResult> MotionController::start(std::uint32_t id, const Action& action,
                                                    const OdometrySample& now) {
  assert(is_executable(action));
  std::optional<MotionResult> never_begun;
  if (waiting_) {
    never_begun = MotionResult{waiting_->id, MotionOutcome::kPreempted, {}};
    waiting_.reset();
  }
  if (active_) {
    end_as(MotionOutcome::kPreempted);
    if (action.type != ActionType::kStop) {
      waiting_ = Order{id, action};
    }
  } else if (action.type != ActionType::kStop) {
    // A start that is not finite begins at the last good sample; the next step tells more.
    take(is_finite(now) ? now : last_);
    begin({id, action});
  }
  return never_begun;
}

MotionStep MotionController::step(const OdometrySample& now, double clear_ahead_m, bool collided) {
  const bool continuous = !has_last_ || is_continuous(now);
  const double period_s =
      has_last_ && continuous ? std::min(now.stamp_s - last_.stamp_s, kLongestPeriod_s) : 0.0;
  MotionStep out;
  if (!continuous && active_) {
    out.result = interrupt();
  }
  if (is_finite(now)) {
    take(now);
  }
  if (!continuous || !active_) {
    if (active_) {
      active_->start = last_;  // what waited is on this side of the jump
    }
    command_ = {};
    return out;
  }

  const bool forward = active_->order.action.type == ActionType::kMoveForward;
  // Written so that NaN is never clear.
  const double must_go_m =
      active_->forward.way_left_m(last_.T_odom_robot) - params_.position_tolerance_m;
  const bool blocked = forward && must_go_m > 0.0 && (collided || !(clear_ahead_m >= must_go_m));
  if (blocked) {
    end_as(MotionOutcome::kBlocked);
    command_ = {};
  } else if (last_.stamp_s - active_->start.stamp_s > params_.action_timeout_s) {
    end_as(MotionOutcome::kTimedOut);
  }
  leave_phase_when_done();
  if (active_->ending) {
    if (at_rest() || last_.stamp_s - active_->ending_since_s > kLongestStop_s) {
      out.result = finish(*active_->ending);
    }
  } else if (active_->phase == Phase::kSettle && at_rest()) {
    active_->phase = next_phase();
    if (active_->phase == Phase::kSettle) {
      out.result = finish(MotionOutcome::kSucceeded);
    }
  }

  if (out.result) {  // the next action begins with the next look ahead
    command_ = {};
    return out;
  }
  const VelocityCommand goal = wanted();
  command_.linear_mps =
      ramped(command_.linear_mps, goal.linear_mps, params_.linear_acceleration, period_s);
  command_.angular_radps =
      ramped(command_.angular_radps, goal.angular_radps, params_.angular_acceleration, period_s);
  if (!is_zero(command_)) {
    last_moving_command_s_ = last_.stamp_s;
  }
  out.command = command_;
  return out;
}

std::optional<MotionResult> MotionController::check_silence(double now_s) {
  if (!active_ || std::abs(now_s - last_.stamp_s) <= params_.odometry_timeout_s) {
    return std::nullopt;
  }
  return interrupt();
}

void MotionController::take(const OdometrySample& now) {
  if (has_last_ && !is_continuous(now)) {
    rest_.reset();
    last_moving_command_s_ = now.stamp_s;
  }
  rest_.update(now);
  last_ = now;
  has_last_ = true;
}

void MotionController::begin(const Order& order) {
  const Pose2& T_odom_start = last_.T_odom_robot;
  const double axes_yaw_rad = order.action.axes_yaw_rad;
  const int quarters =
      nearest_quarter(T_odom_start.yaw - axes_yaw_rad) + quarter_turns(order.action.type);
  const double axis_yaw_rad = axes_yaw_rad + quarters * kPi / 2.0;
  active_ = Active{order,
                   last_,
                   PivotController{params_, axis_yaw_rad},
                   ForwardController{params_, T_odom_start, axis_yaw_rad, order.action.distance_m},
                   Phase::kSettle,
                   std::nullopt,
                   0.0};
  active_->phase = next_phase();
}

void MotionController::end_as(MotionOutcome outcome) {
  if (!active_->ending) {
    active_->ending = outcome;
    active_->ending_since_s = last_.stamp_s;
  }
}

MotionResult MotionController::finish(MotionOutcome outcome) {
  const MotionResult result{active_->order.id, outcome,
                            inverse(active_->start.T_odom_robot) * last_.T_odom_robot};
  active_.reset();
  if (waiting_) {
    const Order next = *waiting_;
    waiting_.reset();
    begin(next);
  }
  return result;
}

MotionResult MotionController::interrupt() {
  command_ = {};
  const MotionResult result = finish(MotionOutcome::kTimedOut);
  if (active_) {
    end_as(MotionOutcome::kTimedOut);
  }
  return result;
}

bool MotionController::is_continuous(const OdometrySample& now) const {
  const double period_s = now.stamp_s - last_.stamp_s;
  const double way_m = norm(now.T_odom_robot.position() - last_.T_odom_robot.position());
  const double turn_rad = std::abs(wrap_angle(now.T_odom_robot.yaw - last_.T_odom_robot.yaw));
  // Written so that NaN is never continuous.
  return period_s >= 0.0 && way_m <= kJump_m + 2.0 * params_.max_linear_mps * period_s &&
         turn_rad <= kJump_rad + 2.0 * params_.max_angular_radps * period_s;
}

bool MotionController::at_rest() const {
  return rest_.at_rest() && is_zero(command_) &&
         last_.stamp_s - last_moving_command_s_ >= RestDetector::kWindow_s;
}

MotionController::Phase MotionController::next_phase() const {
  const Pose2& pose = last_.T_odom_robot;
  if (std::abs(active_->pivot.way_left_rad(pose)) > radians(params_.yaw_tolerance_deg)) {
    return Phase::kPivot;
  }
  const bool forward = active_->order.action.type == ActionType::kMoveForward;
  return forward && active_->forward.way_left_m(pose) > params_.position_tolerance_m
             ? Phase::kDrive
             : Phase::kSettle;
}

void MotionController::leave_phase_when_done() {
  // Half the tolerance: the base rolls on a little.
  const Pose2& pose = last_.T_odom_robot;
  const bool turned =
      active_->phase == Phase::kPivot &&
      std::abs(active_->pivot.way_left_rad(pose)) <= radians(params_.yaw_tolerance_deg) / 2.0;
  const bool driven = active_->phase == Phase::kDrive &&
                      active_->forward.way_left_m(pose) <= params_.position_tolerance_m / 2.0;
  if (turned || driven) {
    active_->phase = Phase::kSettle;
  }
}

VelocityCommand MotionController::wanted() const {
  if (!active_ || active_->ending || active_->phase == Phase::kSettle) {
    return {};
  }
  return active_->phase == Phase::kPivot ? active_->pivot.wanted(last_.T_odom_robot)
                                         : active_->forward.wanted(last_.T_odom_robot);
}

}  // namespace cmn
