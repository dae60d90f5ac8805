// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// From belief and goal to the next action, and whether the journey is over.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "coarse_map_nav/data/action.hpp"
#include "coarse_map_nav/data/belief.hpp"
#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/planning/cost_to_go.hpp"
#include "coarse_map_nav/planning/policy.hpp"

namespace cmn {

struct PlanningParams {
  std::string policy = "path";
  double step_m = 0.15;              ///< CMN: move_forward advances by 0.15 m
  int tree_depth = 2;                ///< CMN's released parameters
  double goal_tolerance_m = 0.4;     ///< CMN's released parameters: success radius
  double reached_confidence = 0.5;
  int max_actions = 500;             ///< CMN: horizon
  std::uint32_t seed = 1;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("policy", self.policy, OneOf{{"random", "heuristic_tree", "path"}}, "how the next action is chosen: CMN's baseline, CMN, Robb");
    visit("step_m", self.step_m, Between{0.02, 2.0}, "[m] length of a forward action");
    visit("tree_depth", self.tree_depth, Between{1, 6}, "[actions] look-ahead of heuristic_tree");
    visit("goal_tolerance_m", self.goal_tolerance_m, Between{0.05, 5.0}, "[m] reached when the estimate is this close to the goal");
    visit("reached_confidence", self.reached_confidence, Between{0.0, 1.0}, "[-] and the belief within 1 m of the estimate is at least this");
    visit("max_actions", self.max_actions, Between{1, 1000000}, "[actions] give up after so many");
    visit("seed", self.seed, Between{0, 4294967295.0}, "seed of the policy's random choices");
  }
};

/// How the journey stands; values as in msg/NavigationStatus.
enum class NavigationState : std::uint8_t { kWaitingForMap = 0, kLocalizing, kNavigating, kReached, kFailed, kStopped };

/// What to do now.
struct Decision {
  NavigationState state = NavigationState::kStopped;
  Action action;            ///< kStop when the state is an end
  double distance_to_go_m = 0.0;  ///< along the path, NaN without one
  std::string text;         ///< one sentence for a person
};

/// What the localizer says, as the planner needs it.
struct Localization {
  const Belief& belief;
  Estimate estimate;
  double confidence = 0.0;
  bool is_converged = false;
};

/// Holds the goal, asks the policy, declares the end.
class Planner {
 public:
  Planner(CoarseMap map, const PlanningParams& params);

  /// The reason why `goal` [m, map frame] cannot be one (outside the drawing, on an occupied cell,
  /// with no free neighbour); nothing when it is taken.
  std::optional<std::string> set_goal(Point2 goal_map);
  void cancel_goal();
  std::optional<Cell> goal() const { return goal_; }

  /// One decision; counts the actions since the goal was set.
  Decision decide(const Localization& localization, bool is_blocked_ahead);
  /// The cells from `from` to the goal along the least cost; empty when there is no way.
  std::vector<Cell> path_from(Cell from) const;
  int actions() const { return actions_; }

 private:
  CoarseMap map_;
  PlanningParams params_;
  std::unique_ptr<Policy> policy_;
  std::mt19937_64 rng_;
  std::optional<Cell> goal_;
  CostToGo cost_to_go_;
  int actions_ = 0;
};

}  // namespace cmn
