// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The planner that all methods share in the evaluation: the drawing says where to, the lattice
/// through what is seen says how.
#pragma once

#include "coarse_map_nav/planning/exploration.hpp"
#include "coarse_map_nav/planning/local_lattice.hpp"
#include "coarse_map_nav/planning/policy.hpp"

namespace cmn {

/// Takes the first action towards the state of the lattice with the least sum of the way there and
/// the cost-to-go, on the drawing, of the place where the estimate puts that state (ours).
///
/// While the belief has not converged, where no way leads on from the estimate and where no state
/// in reach is better than standing still, it explores at random as the other policies do.
class LatticePolicy : public Policy {
 public:
  LatticePolicy(const LatticeParams& lattice, double step_m, double p_turn)
      : lattice_{lattice, step_m}, p_turn_{p_turn} {}
  /// Throws std::invalid_argument without a local map.
  ActionType choose(const Situation& situation, std::mt19937_64& rng) override;
  void reset() override { exploration_.reset(); }

 private:
  LocalLattice lattice_;
  double p_turn_;
  Exploration exploration_;
};

}  // namespace cmn
