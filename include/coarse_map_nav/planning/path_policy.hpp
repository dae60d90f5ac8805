// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Robb's planner, and CMN's baseline without one.
#pragma once

#include "coarse_map_nav/planning/exploration.hpp"
#include "coarse_map_nav/planning/policy.hpp"

#include <random>

namespace cmn {

/// Robb, "CMN Components: Planning": the first cell of the path lies ahead => forward, otherwise
/// turn towards it; while the belief is flat, explore at random; when blocked, turn at random and
/// take a detour (Exploration::follow).
///
/// Of several shortest paths the one that begins ahead is taken; between left and right, and for a
/// way that leads back, the side from which the goal is nearer, by chance if neither is.
class PathPolicy : public Policy {
 public:
  explicit PathPolicy(double p_turn) : p_turn_{p_turn} {}
  ActionType choose(const Situation& situation, std::mt19937_64& rng) override;
  void reset() override { exploration_.reset(); }

 private:
  double p_turn_;
  Exploration exploration_;
};

/// CMN's baseline RND: any action that is not blocked, each as likely.
class RandomPolicy : public Policy {
 public:
  ActionType choose(const Situation& situation, std::mt19937_64& rng) override;
};

}  // namespace cmn
