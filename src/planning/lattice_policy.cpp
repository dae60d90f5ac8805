// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/lattice_policy.hpp"

#include "coarse_map_nav/planning/cost_to_go.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace cmn {
namespace {

/// The way there is dearer than the cost-to-go counts (turns, nearness): progress must still pay.
constexpr double kGreed = 2.0;

}  // namespace

ActionType LatticePolicy::choose(const Situation& situation, std::mt19937_64& rng) {
  if (situation.local_map == nullptr) {
    throw std::invalid_argument("the lattice policy needs a local map");
  }
  const std::vector<LatticeState>& states =
      lattice_.search(*situation.local_map, !situation.is_stuck);
  const auto wander = [&] {
    const bool is_blocked = std::none_of(states.begin(), states.end(), [](const LatticeState& s) {
      return s.action == ActionType::kMoveForward && s.parent == 0;
    });
    return exploration_.wander(is_blocked, p_turn_, rng);
  };
  const Estimate& at = situation.estimate;
  if (!situation.is_converged || !situation.cost_to_go.is_reachable(at.cell)) {
    return wander();
  }

  const double cell_m = situation.map.resolution();
  double least_m = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  const double c = std::cos(situation.yaw_rad);
  const double s = std::sin(situation.yaw_rad);
  for (const std::size_t i : lattice_.places()) {
    if (states[i].cost_m >= least_m) {
      break;  // and so are all that follow
    }
    const Point2 p = lattice_.position_of(states[i]);
    const Point2 ahead{c * p.x - s * p.y, s * p.x + c * p.y};
    const double to_go_m = cell_m * situation.cost_to_go.between_cells(situation.position_cells +
                                                                       (1.0 / cell_m) * ahead);
    if (states[i].cost_m + kGreed * to_go_m < least_m) {
      least_m = states[i].cost_m + kGreed * to_go_m;
      best = i;
    }
  }
  if (best == 0) {
    return wander();
  }
  exploration_.reset();
  return lattice_.first_action(best);
}

}  // namespace cmn
