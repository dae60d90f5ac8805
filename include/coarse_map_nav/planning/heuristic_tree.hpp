// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// CMN's planner: the action that begins the motion most alike to the way to the goal.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/planning/exploration.hpp"
#include "coarse_map_nav/planning/policy.hpp"

#include <random>
#include <vector>

namespace cmn {

/// The tree of all action sequences of a length, and the choice among its leaves (CMN sec. IV-D).
class ActionTree {
 public:
  /// `depth` >= 2: a single turn goes nowhere, so that a tree of depth 1 never turns.
  explicit ActionTree(int depth);
  /// The first action of the leaf whose displacement has the greatest cosine with `h`, an offset in
  /// the robot's frame (x forward, y left). A leaf or an `h` of length 0 counts as cosine 0. Ties
  /// (the paper does not say): fewer turns, then farther, then chance. `may_go_forward` false
  /// excludes the leaves that begin with a step forward.
  ActionType choose(Cell h, bool may_go_forward, std::mt19937_64& rng) const;

 private:
  struct Leaf {
    ActionType first = ActionType::kStop;
    Cell displacement;  ///< [steps] x forward, y left
    int turns = 0;
  };
  std::vector<Leaf> leaves_;
};

/// CMN's planner. The estimate is taken at its word, however uncertain it is.
///
/// h is the first step of the A* path from the estimate to the goal, turned into the robot's frame
/// by the estimated heading. The paper does not say which cells are neighbours; four is the default
/// here, as in the authors' released code, because the robot turns by 90 degrees: to a diagonal h
/// the leaves ahead and aside are equally good, and only the tie rule would steer. With four, A*'s
/// first step is the downhill step of the cost-to-go, which is known already.
///
/// Departure: the paper's robot slides along walls and so is never blocked. Here
/// Exploration::follow leads it around. Where there is no h (at the goal, or no way), it wanders.
class HeuristicTree : public Policy {
 public:
  HeuristicTree(int depth, bool uses_diagonals, double p_turn)
      : tree_{depth}, uses_diagonals_{uses_diagonals}, p_turn_{p_turn} {}
  ActionType choose(const Situation& situation, std::mt19937_64& rng) override;
  void reset() override { exploration_.reset(); }

 private:
  ActionTree tree_;
  bool uses_diagonals_;
  double p_turn_;
  Exploration exploration_;
};

}  // namespace cmn
