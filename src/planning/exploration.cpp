// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/exploration.hpp"

#include "coarse_map_nav/data/random.hpp"

namespace cmn {

ActionType draw_turn(std::mt19937_64& rng) {
  return draw_index(rng, 2) == 0 ? ActionType::kTurnLeft : ActionType::kTurnRight;
}

ActionType Exploration::turn(ActionType side) {
  turned_ = side;
  return side;
}

ActionType Exploration::forward() {
  turned_ = ActionType::kStop;
  return ActionType::kMoveForward;
}

ActionType Exploration::wander(bool is_blocked_ahead, double p_turn, std::mt19937_64& rng) {
  detour_left_ = 0;
  if (turned_ != ActionType::kStop) {
    return is_blocked_ahead ? turn(turned_) : forward();
  }
  return is_blocked_ahead || draw_uniform(rng) < p_turn ? turn(draw_turn(rng)) : forward();
}

ActionType Exploration::follow(ActionType wish, bool is_blocked_ahead, ActionType turn_if_blocked) {
  if (detour_left_ > 0) {
    if (!is_blocked_ahead) {
      --detour_left_;
      return forward();
    }
    if (turned_ != ActionType::kStop) {
      return turn(turned_);
    }
    detour_left_ = 0;
  }
  if (wish == ActionType::kMoveForward && is_blocked_ahead) {
    detour_length_ =
        detour_length_ == 0 || detour_length_ == kLongestDetour ? 1 : 2 * detour_length_;
    detour_left_ = detour_length_;
    followed_ = 0;
    return turn(turn_if_blocked);
  }
  if (wish == ActionType::kMoveForward) {
    if (++followed_ > 2 * detour_length_) {
      detour_length_ = 0;
    }
    return forward();
  }
  const bool undoes_a_turn = turned_ != ActionType::kStop && turned_ != wish;
  if (undoes_a_turn) {
    return is_blocked_ahead ? turn(turned_) : forward();
  }
  return turn(wish);
}

}  // namespace cmn
