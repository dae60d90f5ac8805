// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Getting about without a plan, and past what the plan does not know.
#pragma once

#include "coarse_map_nav/data/action.hpp"

#include <random>

namespace cmn {

/// Either turn, by chance.
ActionType draw_turn(std::mt19937_64& rng);

/// Remembers what was ordered, so that a robot neither turns on the spot for ever nor pushes for
/// ever against an obstacle that only the world has.
///
/// Two rules hold for both ways of moving: after a turn the robot goes forward if it can, and if it
/// cannot it turns on to the same side; so it leaves any corner that has a way out.
class Exploration {
 public:
  /// Random walk (Robb: "the robot moves randomly to explore its surroundings"): forward while that
  /// is free, except that now and then, with `p_turn`, it turns to a random side.
  ActionType wander(bool is_blocked_ahead, double p_turn, std::mt19937_64& rng);

  /// Carries out what a planner wishes, with two exceptions (ours).
  ///
  /// A turn is not taken back by the next action, as an estimate that hops to and fro would have
  /// it. And where the way forward is wished but blocked (drawing or estimate is wrong), a detour
  /// begins: `turn_if_blocked`, then forward, unheeding of wishes, for one step. Each further
  /// detour is twice as long as the one before; after kLongestDetour comes one step again, since
  /// what a short detour leaves a long one may overshoot. The first of a row is short: the row ends
  /// when twice as many forward steps as the last detour had went as wished. A detour ends early
  /// when it is blocked itself.
  ActionType follow(ActionType wish, bool is_blocked_ahead, ActionType turn_if_blocked);

  void reset() { *this = Exploration{}; }

  static constexpr int kLongestDetour = 16;  ///< [steps] 2.4 m with CMN's 0.15 m

 private:
  ActionType turn(ActionType side);
  ActionType forward();

  ActionType turned_ = ActionType::kStop;  ///< the side, if the last action was a turn
  int detour_left_ = 0;                    ///< [steps]
  int detour_length_ = 0;                  ///< [steps] of the last detour, 0 = none
  int followed_ = 0;                       ///< [steps] as wished since the last detour
};

}  // namespace cmn
