// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the robot can reach through what it sees: a search over forward steps and quarter turns.
#pragma once

#include "coarse_map_nav/data/action.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/planning/clearance_map.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cmn {

struct LatticeParams {
  double reach_m = 3.0;
  double clearance_m = 0.19;
  double comfort_m = 0.3;
  double discomfort = 0.5;
  double turn_cost_m = 0.1;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("reach_m", self.reach_m, Between{0.2, 20.0},
          "[m] lattice search: how far ahead, behind and aside of the robot");
    visit("clearance_m", self.clearance_m, Between{0.0, 2.0},
          "[m] lattice search: least distance from the robot's middle to what is seen");
    visit("comfort_m", self.comfort_m, Between{0.0, 2.0},
          "[m] lattice search: from this distance on, nearness costs nothing");
    visit("discomfort", self.discomfort, Between{0.0, 100.0},
          "[-] lattice search: a step at clearance_m costs as much more as so many of its length");
    visit("turn_cost_m", self.turn_cost_m, Between{0.0, 5.0},
          "[m] lattice search: a quarter turn costs as much as so long a way");
  }
};

/// A pose that the robot can drive to, in steps of the lattice from where it stands.
struct LatticeState {
  Cell offset;                            ///< [steps] x forward, y left of the robot
  int quarter_turns = 0;                  ///< of the robot there against now, 0 to 3, to the left
  double cost_m = 0.0;                    ///< way driven plus the price of turns and of nearness
  std::int32_t parent = -1;               ///< index among the states found
  ActionType action = ActionType::kStop;  ///< that leads here from the parent
};

/// Dijkstra over (step forward, turn left, turn right) through a local occupancy grid that is
/// aligned with the robot. A step is possible when its middle and its end lie on cells that were
/// seen to be free, at least `clearance_m` from everything seen to be occupied; a robot that stands
/// nearer than that may leave towards more clearance. A robot in a pocket without a way out got in
/// somehow: then what is in the way (a bumper's contacts, drift) is not as exact as it seems, and
/// half, at last a quarter of the clearance is asked for.
///
/// The search does not know the drawing: it tells what is possible, not what is good.
class LocalLattice {
 public:
  LocalLattice(const LatticeParams& params, double step_m) : params_{params}, step_m_{step_m} {}

  /// All poses within reach, in the order of their cost; the first is where the robot stands.
  /// `may_go_forward` false: the first step ahead is ruled out (a bumper).
  /// The result is good until the next call.
  const std::vector<LatticeState>& search(const LocalOccupancy& local, bool may_go_forward = true);
  const std::vector<LatticeState>& states() const { return states_; }
  /// Of each place among them the first state, the cheapest, in the same order.
  const std::vector<std::size_t>& places() const { return places_; }
  /// Of the last search.
  const ClearanceMap& clearance() const { return clearance_; }
  /// The first action on the way to a state of the last search, kStop for the first state.
  ActionType first_action(std::size_t state) const;
  double step_m() const { return step_m_; }
  double least_clearance_m() const { return params_.clearance_m; }
  /// Where a state lies in the robot's frame [m].
  Point2 position_of(const LatticeState& state) const {
    return {state.offset.x * step_m_, state.offset.y * step_m_};
  }

 private:
  void look_at(const LocalOccupancy& local);
  void search_with(double clearance_m, bool may_go_forward);
  double clearance_at(Cell half_steps) const;
  /// The price of the step between two neighbours of the lattice [m], infinite when impossible.
  double step_cost_m(Cell from, Cell to, double clearance_m) const;

  LatticeParams params_;
  double step_m_;
  ClearanceMap clearance_;
  int reach_ = 0;                         ///< [steps]
  std::vector<int> column_of_half_step_;  ///< of the local map, from -2 reach_ on
  std::vector<LatticeState> states_;
  std::vector<std::size_t> places_;
  // Kept from search to search for their memory.
  std::vector<std::uint32_t> cost_;
  std::vector<std::uint8_t> is_found_;
  std::vector<std::vector<LatticeState>> buckets_;
};

}  // namespace cmn
