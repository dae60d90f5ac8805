// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/policy.hpp"

#include "coarse_map_nav/planning/belief_policy.hpp"
#include "coarse_map_nav/planning/heuristic_tree.hpp"
#include "coarse_map_nav/planning/lattice_policy.hpp"
#include "coarse_map_nav/planning/path_policy.hpp"
#include "coarse_map_nav/planning/planner.hpp"

#include <stdexcept>

namespace cmn {

std::unique_ptr<Policy> make_policy(const PlanningParams& params) {
  if (params.policy == "random") {
    return std::make_unique<RandomPolicy>();
  }
  if (params.policy == "heuristic_tree") {
    return std::make_unique<HeuristicTree>(params.tree_depth, params.tree_diagonals,
                                           params.explore_p_turn);
  }
  if (params.policy == "path") {
    return std::make_unique<PathPolicy>(params.explore_p_turn);
  }
  if (params.policy == "lattice") {
    return std::make_unique<LatticePolicy>(params.lattice, params.step_m, params.explore_p_turn);
  }
  if (params.policy == "belief") {
    return std::make_unique<BeliefPolicy>(params.lattice, params.map_repair, params.step_m,
                                          params.information);
  }
  throw std::invalid_argument("planning policy \"" + params.policy +
                              "\" is none of random, heuristic_tree, path, lattice, belief");
}

}  // namespace cmn
