// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// From belief and goal to the next action, and whether the journey is over.
#pragma once

#include "coarse_map_nav/data/action.hpp"
#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/localization.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/planning/cost_to_go.hpp"
#include "coarse_map_nav/planning/decision.hpp"
#include "coarse_map_nav/planning/local_lattice.hpp"
#include "coarse_map_nav/planning/map_repair.hpp"
#include "coarse_map_nav/planning/policy.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace cmn {

struct PlanningParams {
  std::string policy = "path";
  double step_m = kCmnStep_m;
  LatticeParams lattice;
  MapRepairParams map_repair;
  int tree_depth = 2;           ///< CMN's released parameters
  bool tree_diagonals = false;  ///< see HeuristicTree
  /// A turn every 1.5 m of CMN's steps. Of 0 to 0.3 it saw most of a flat in 300 and 500 actions.
  double explore_p_turn = 0.1;
  bool information = true;
  double goal_tolerance_m = 0.4;  ///< CMN's released parameters: success radius
  double reached_confidence = 0.5;
  int max_actions = 500;  ///< CMN: horizon
  std::uint32_t seed = 1;
  bool needs_local_map() const { return policy == "lattice" || policy == "belief"; }
  bool uses_expected_looks() const { return policy == "belief" && information; }
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("policy", self.policy, OneOf{{"random", "heuristic_tree", "path", "lattice", "belief"}},
          "how the next action is chosen: CMN's baseline, CMN, Robb, ours on the estimate, ours");
    visit("step_m", self.step_m, Between{0.02, 2.0}, "[m] length of a forward action");
    visit.group("lattice", self.lattice);
    visit.group("map_repair", self.map_repair);
    visit("tree_depth", self.tree_depth, Between{2, 6}, "[actions] look-ahead of heuristic_tree");
    visit("tree_diagonals", self.tree_diagonals, Anything{},
          "heuristic_tree: the path to the goal may go along diagonals");
    visit("explore_p_turn", self.explore_p_turn, Between{0.0, 1.0},
          "[-] P(a turn at a step of the random exploration), where forward is free");
    visit("information", self.information, Anything{},
          "belief: while lost, the way is worth what looks on it are expected to tell");
    visit("goal_tolerance_m", self.goal_tolerance_m, Between{0.05, 5.0},
          "[m] reached when the estimate is this close to the goal");
    visit("reached_confidence", self.reached_confidence, Between{0.0, 1.0},
          "[-] and the belief within 1 m of the estimate is at least this");
    visit("max_actions", self.max_actions, Between{1, 1000000}, "[actions] give up after so many");
    visit("seed", self.seed, Between{0, 4294967295.0}, "seed of the policy's random choices");
  }
};

/// Holds the goal, asks the policy, declares the end.
///
/// The state follows from what is given: no goal, kStopped; belief not converged, or an estimate
/// from where there is no way to the goal, kLocalizing (the policy explores); otherwise
/// kNavigating. Two states are ends and stay until the next set_goal or cancel_goal:
///  - kReached: the belief has converged, its confidence is at least reached_confidence, and the
///    estimate is in the goal's cell or within goal_tolerance_m of its centre, in nominal metres,
///    with no wall in between: the path is no longer than paths of that reach are without walls.
///    Asked before an action is chosen, so a robot that passes the goal stops there.
///  - kFailed: max_actions were ordered, or the belief has converged and hardly any of it
///    (kNegligibleMass) is where a way leads to the goal.
class Planner {
 public:
  /// Throws std::invalid_argument when `params.policy` is unknown.
  Planner(CoarseMap map, const PlanningParams& params);

  /// The reason why `goal` [m, map frame] cannot be one (outside the drawing, on an occupied cell,
  /// with no free neighbour) and what to choose instead; the goal held before stays. Nothing when
  /// it is taken: the journey begins anew.
  std::optional<std::string> set_goal(Point2 goal_map);
  void cancel_goal();
  std::optional<Cell> goal() const { return goal_; }

  /// How the action that was last decided on ended. A step forward that ended blocked leaves the
  /// way ahead blocked until the robot has turned, whatever the guard sees: a thin leg or the edge
  /// of a door fills too little of the front block.
  void action_ended(MotionOutcome outcome) {
    if (is_pivoting_) {
      return;  // nothing was learned about the way ahead
    }
    is_stuck_ = last_action_ == ActionType::kMoveForward && outcome == MotionOutcome::kBlocked;
  }
  /// One decision; counts the actions since the goal was set. `is_blocked_ahead` is the obstacle
  /// guard's word; `local_map` is what the robot sees farther around, where the policy asks for it.
  Decision decide(const Localization& localization, bool is_blocked_ahead,
                  const LocalOccupancy* local_map = nullptr);
  /// In place of a decision while perception has seen only part of what it could from here: a turn
  /// to the left, so that it may look there. Not one of max_actions.
  Decision look_round(double axes_yaw_rad);
  /// The cells from `from` to the goal along the least cost; empty when there is no way or no goal.
  std::vector<Cell> path_from(Cell from) const;
  int actions() const { return actions_; }
  /// Turns for the sake of a look since the goal was set.
  int pivots() const { return pivots_; }
  /// What the policy has learned about the drawing; null: nothing.
  const RepairedMap* repaired_map() const { return policy_->repaired_map(); }

  /// Less belief than this is taken for none when asking whether the goal can be reached at all.
  static constexpr double kNegligibleMass = 1e-3;

 private:
  bool is_at_goal(const Situation& situation) const;
  double reachable_mass(const Belief& belief) const;
  Decision end(NavigationState state, double distance_m, std::string text);
  Decision act(const Situation& situation, double distance_m);

  CoarseMap map_;
  PlanningParams params_;
  std::unique_ptr<Policy> policy_;
  std::mt19937_64 rng_;
  std::optional<Cell> goal_;
  Point2 goal_cells_;  ///< finer than its cell
  CostToGo cost_to_go_;
  int actions_ = 0;
  int pivots_ = 0;
  bool is_pivoting_ = false;
  ActionType last_action_ = ActionType::kStop;
  bool is_stuck_ = false;
  std::optional<Decision> end_;
};

}  // namespace cmn
