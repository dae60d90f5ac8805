// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One action at a time: from order to velocities to what was really driven.
#pragma once

#include "coarse_map_nav/data/action.hpp"
#include "coarse_map_nav/data/odometry.hpp"
#include "coarse_map_nav/motion/forward_controller.hpp"
#include "coarse_map_nav/motion/motion_params.hpp"
#include "coarse_map_nav/motion/pivot_controller.hpp"
#include "coarse_map_nav/motion/rest_detector.hpp"

#include <cstdint>
#include <limits>
#include <optional>

namespace cmn {

/// What to send to the base now, and the result when the action has just ended.
struct MotionStep {
  VelocityCommand command;
  std::optional<MotionResult> result;
};

/// False for what nobody can carry out: a type that is none of ActionType (a message may hold any
/// number), a forward distance that is negative or not finite, axes that are no angle.
bool is_executable(const Action& action);

/// Carries out one action at a time, driven by odometry samples; no clock of its own.
///
/// A pivot ends on the *exact* next axis, counted from the axis nearest to the yaw at its start. A
/// forward step goes along the nearest axis; off that axis by more than the tolerance, it turns on
/// the spot first. The axes are those of Action::axes_yaw_rad: the odometry's own (Robb), or, where
/// the odometry drifts, what somebody has found the building's to be in it. A way ahead that is
/// clear for less than the rest of a forward step, or a collision, ends it as kBlocked, with zero
/// velocity in the same step and no motion at all if it was so from the start; neither stops a
/// pivot, nor a forward step that has come to its end. All other ends brake within the acceleration
/// limits.
///
/// An action ends only when the base stands still (see RestDetector) and zero has been commanded
/// for as long, so the next one starts from rest, and results chain without a gap: what a
/// braking or coasting base still drove is in the result. If at rest it is not where it should be,
/// it is corrected until action_timeout_s has passed.
///
/// Faults: time running backwards (a bag that loops, a reset clock), a pose that jumps (the base
/// driver restarted) or is not finite end the action at once as kTimedOut, with zero velocity and
/// the displacement up to the last good sample. An action that waits ends with it.
class MotionController {
 public:
  explicit MotionController(const MotionParams& params) : params_{params} {}

  /// Orders `action`. From rest it begins at `now`; otherwise the one under way is braked first,
  /// ends as kPreempted in a later step(), and `action` begins then. kStop only does the former.
  /// Returned is the result of an earlier order that was still waiting and will never begin.
  /// `action` must be executable.
  std::optional<MotionResult> start(std::uint32_t id, const Action& action,
                                    const OdometrySample& now);
  /// The next command; call it for every odometry sample. Zero when there is no action.
  /// `clear_ahead_m`: so far the way ahead is clear; 0: blocked, infinite: free.
  MotionStep step(const OdometrySample& now, double clear_ahead_m, bool collided);
  MotionStep step(const OdometrySample& now, bool obstacle_ahead, bool collided) = delete;
  /// Call with the current time when no odometry came: past odometry_timeout_s the action ends as
  /// kTimedOut with what was driven up to the last sample. Send zero velocity then. An action that
  /// waited is ended by the next call.
  std::optional<MotionResult> check_silence(double now_s);
  bool is_idle() const { return !active_ && !waiting_; }

 private:
  struct Order {
    std::uint32_t id = 0;
    Action action;
  };
  enum class Phase { kPivot, kDrive, kSettle };
  struct Active {
    Order order;
    OdometrySample start;
    PivotController pivot;
    ForwardController forward;
    Phase phase = Phase::kSettle;
    std::optional<MotionOutcome> ending;  ///< decided; only rest is waited for
    double ending_since_s = 0.0;
  };
  void take(const OdometrySample& now);
  void begin(const Order& order);
  void end_as(MotionOutcome outcome);
  MotionResult finish(MotionOutcome outcome);
  MotionResult interrupt();
  bool is_continuous(const OdometrySample& now) const;
  bool at_rest() const;
  /// Where to go on from rest; kSettle when the action has come to its end.
  Phase next_phase() const;
  void leave_phase_when_done();
  VelocityCommand wanted() const;

  MotionParams params_;
  std::optional<Active> active_;
  std::optional<Order> waiting_;
  OdometrySample last_;
  bool has_last_ = false;
  RestDetector rest_;
  VelocityCommand command_;
  double last_moving_command_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace cmn
