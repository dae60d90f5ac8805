// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/path_policy.hpp"

#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/planning/cost_to_go.hpp"

namespace cmn {
namespace {

/// The turn after which the goal is nearer straight on; by chance if that is the same.
ActionType better_turn(const Situation& s, std::mt19937_64& rng) {
  const Cell here = s.estimate.cell;
  const double left = s.cost_to_go(here + unit_step(turned(s.estimate.heading, 1)));
  const double right = s.cost_to_go(here + unit_step(turned(s.estimate.heading, -1)));
  return left < right   ? ActionType::kTurnLeft
         : right < left ? ActionType::kTurnRight
                        : draw_turn(rng);
}

}  // namespace

ActionType PathPolicy::choose(const Situation& situation, std::mt19937_64& rng) {
  const auto towards =
      situation.cost_to_go.next_heading(situation.estimate.cell, situation.estimate.heading);
  if (!situation.is_converged || !towards) {
    return exploration_.wander(situation.is_blocked_ahead, p_turn_, rng);
  }
  const bool is_ahead = *towards == situation.estimate.heading;
  return exploration_.follow(is_ahead ? ActionType::kMoveForward : better_turn(situation, rng),
                             situation.is_blocked_ahead, draw_turn(rng));
}

ActionType RandomPolicy::choose(const Situation& situation, std::mt19937_64& rng) {
  switch (draw_index(rng, situation.is_blocked_ahead ? 2 : 3)) {
    case 0:
      return ActionType::kTurnLeft;
    case 1:
      return ActionType::kTurnRight;
    default:
      return ActionType::kMoveForward;
  }
}

}  // namespace cmn
