// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One action at a time: from order to velocities to what was really driven.
#pragma once

#include <cstdint>
#include <optional>

#include "coarse_map_nav/data/action.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/param_tree.hpp"

namespace cmn {

/// A pose in the odometry frame and when it held.
struct OdometrySample {
  double stamp_s = 0.0;
  Pose2 T_odom_robot;
};

struct VelocityCommand {
  double linear_mps = 0.0;    ///< forward
  double angular_radps = 0.0;  ///< left
};

struct MotionParams {
  double max_linear_mps = 0.3;     ///< Robb, Kobuki
  double max_angular_radps = 1.0;  ///< Robb, Kobuki
  double linear_acceleration = 0.5;
  double angular_acceleration = 1.5;
  double heading_gain = 2.0;
  double position_tolerance_m = 0.01;
  double yaw_tolerance_deg = 0.5;
  double odometry_timeout_s = 0.5;
  double action_timeout_s = 15.0;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("max_linear_mps", self.max_linear_mps, Between{0.01, 3.0}, "[m/s] top speed forward");
    visit("max_angular_radps", self.max_angular_radps, Between{0.05, 6.0}, "[rad/s] top speed of a pivot");
    visit("linear_acceleration", self.linear_acceleration, Between{0.05, 5.0}, "[m/s^2] ramp of the forward speed");
    visit("angular_acceleration", self.angular_acceleration, Between{0.05, 20.0}, "[rad/s^2] ramp of the pivot speed");
    visit("heading_gain", self.heading_gain, Between{0.0, 10.0}, "[1/s] turn rate per radian off the axis while driving forward");
    visit("position_tolerance_m", self.position_tolerance_m, Between{0.001, 0.5}, "[m] a forward step ends this close to its length");
    visit("yaw_tolerance_deg", self.yaw_tolerance_deg, Between{0.05, 20.0}, "[deg] a pivot ends this close to the axis");
    visit("odometry_timeout_s", self.odometry_timeout_s, Between{0.05, 10.0}, "[s] stop when odometry is silent for so long");
    visit("action_timeout_s", self.action_timeout_s, Between{0.5, 120.0}, "[s] give an action up after so long");
  }
};

/// What to send to the base now, and the result when the action has just ended.
struct MotionStep {
  VelocityCommand command;
  std::optional<MotionResult> result;
};

/// Carries out one action at a time, driven by odometry samples; no clock of its own.
///
/// Pivot (Robb, "Better Pivot Controller"): trapezoidal speed, to the *exact* next axis of the
/// odometry frame, so that slip does not add up. Forward (Robb, "Forward Motion Controller"): the
/// same ramps along the axis nearest to the heading, which is held. An obstacle ends a forward step
/// at once as kBlocked, as does `collided`; neither stops a pivot.
class MotionController {
 public:
  explicit MotionController(const MotionParams& params) : params_{params} {}

  /// Begins `action`; one under way ends as kPreempted, and its result is returned. kStop only ends.
  std::optional<MotionResult> start(std::uint32_t id, const Action& action, const OdometrySample& now);
  /// The next command. At rest (no action) it is zero and there is no result.
  MotionStep step(const OdometrySample& now, bool obstacle_ahead, bool collided);
  /// Call with the current time when no odometry came: past odometry_timeout_s the action ends as
  /// kTimedOut with what was driven up to the last sample.
  std::optional<MotionResult> check_silence(double now_s);
  bool is_idle() const { return !active_.has_value(); }

 private:
  struct Active {
    std::uint32_t id = 0;
    Action action;
    OdometrySample start;
    OdometrySample last;
    double axis_yaw_rad = 0.0;  ///< of the axis to end on (pivot) or to hold (forward)
    VelocityCommand command;
  };
  MotionResult finish(MotionOutcome outcome);

  MotionParams params_;
  std::optional<Active> active_;
};

}  // namespace cmn
