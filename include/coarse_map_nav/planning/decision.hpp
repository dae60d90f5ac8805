// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the planner says: an action, how the journey stands, and a sentence about it.
#pragma once

#include "coarse_map_nav/data/action.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace cmn {

/// How the journey stands; values as in msg/NavigationStatus.
enum class NavigationState : std::uint8_t {
  kWaitingForMap = 0,
  kLocalizing,
  kNavigating,
  kReached,
  kFailed,
  kStopped
};

/// What to do now.
struct Decision {
  NavigationState state = NavigationState::kStopped;
  Action action;  ///< kStop when the state is an end
  double distance_to_go_m = std::numeric_limits<double>::quiet_NaN();  ///< NaN without a path
  std::string text;       ///< one sentence for a person
  bool is_pivot = false;  ///< the action completes a look and is not counted
};

/// To stand still, and why.
inline Decision resting(NavigationState state, std::string why) {
  return {state, Action{}, std::numeric_limits<double>::quiet_NaN(), std::move(why)};
}

}  // namespace cmn
