// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Ours: what is possible by the lattice, what it is worth by the whole belief.
#pragma once

#include "coarse_map_nav/planning/information.hpp"
#include "coarse_map_nav/planning/learned_places.hpp"
#include "coarse_map_nav/planning/local_lattice.hpp"
#include "coarse_map_nav/planning/map_repair.hpp"
#include "coarse_map_nav/planning/policy.hpp"
#include "coarse_map_nav/planning/repaired_cost_to_go.hpp"

#include <deque>
#include <optional>
#include <vector>

namespace cmn {

/// Of all poses that the robot can drive to through what it sees, takes the one with the least sum
/// of the way there and the expected cost-to-go from there, the expectation over where the robot
/// may be (QMDP, Littman et al. 1995), on a map that is repaired as the robot goes.
///
/// A goal on which all hypotheses agree is thus driven to before the belief has converged. Where
/// they disagree, the way is worth what looks on it are expected to tell (information.hpp); and
/// where standing still would yet be best, the robot explores.
class BeliefPolicy : public Policy {
 public:
  BeliefPolicy(const LatticeParams& lattice, const MapRepairParams& repair, double step_m,
               bool information);
  /// Throws std::invalid_argument without a local map.
  void look(const Situation& situation) override;
  ActionType choose(const Situation& situation, std::mt19937_64& rng) override;
  void reset() override;
  std::optional<double> distance_to_go_m(const Situation& situation) override;
  bool is_as_near_as_can_be() const override { return best_ == 0; }
  const RepairedMap* repaired_map() const override { return map_ ? &*map_ : nullptr; }

 private:
  /// Into the map, as far as the robot is sure where it looks at.
  void learn(const Situation& situation);
  void update_cost_to_go(const Situation& situation);
  static std::vector<Hypothesis> hypotheses(const Situation& situation);
  /// The likeliest of the candidates, all together 1.
  static std::vector<Hypothesis> weighed(const Situation& situation,
                                         std::vector<Estimate> candidates);
  /// The state of the lattice with the least expected cost; 0 when that is to stay.
  std::size_t best_state(const Situation& situation, const std::vector<Hypothesis>& at) const;
  /// Of each place of the lattice what looks on the way there are expected to save [m].
  std::vector<double> savings_m(const Situation& situation,
                                const std::vector<Hypothesis>& at) const;
  /// How far a place of the lattice is from where the robot has been, at most `most_m` [m].
  double newness_m(Cell offset, double most_m) const;
  /// The goal would lead through a gap that the lattice does not fit through: closes it.
  bool close_gap(const Situation& situation);
  void remember(ActionType action);
  bool may_go_forward() const;
  bool is_near_target(Cell offset) const;
  /// To where the robot has not been.
  ActionType explore(std::mt19937_64& rng);

  LocalLattice lattice_;
  MapRepairParams repair_;
  bool information_;
  std::optional<RepairedMap> map_;
  LearnedPlaces places_;
  RepairedCostToGo cost_to_go_;
  bool has_goal_ = false;               ///< cost_to_go_ leads to it
  std::vector<Hypothesis> hypotheses_;  ///< where the robot may be
  std::size_t best_ = 0;                ///< state of the lattice to go to; 0: stay
  std::optional<Cell> target_;  ///< of the last decision, from where the robot is now [steps]
  std::deque<Cell> trail_;      ///< where it has been, from where it is now [steps]
  ActionType last_ = ActionType::kStop;
  int turns_ = 0;  ///< without a step between them
};

}  // namespace cmn
