// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/planner.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <utility>

namespace cmn {
namespace {

std::string text_of(Cell c) { return "(" + std::to_string(c.x) + ", " + std::to_string(c.y) + ")"; }

std::string text_of(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string text_of(Point2 p) { return "(" + text_of(p.x, 2) + ", " + text_of(p.y, 2) + ") m"; }

bool has_free_neighbour(const CoarseMap& map, Cell c) {
  return std::any_of(kHeadings.begin(), kHeadings.end(),
                     [&](Heading h) { return map.is_free(c + unit_step(h)); });
}

/// The sentence's end that tells the fix: the usable cell nearest to a point of the map frame.
std::string nearest_goal(const CoarseMap& map, Point2 p_map) {
  std::optional<Cell> nearest;
  for (std::size_t i = 0; i < map.occupied().size(); ++i) {
    const Cell c = map.occupied().cell_at(i);
    if (map.is_free(c) && has_free_neighbour(map, c) &&
        (!nearest || norm(map.center_of(c) - p_map) < norm(map.center_of(*nearest) - p_map))) {
      nearest = c;
    }
  }
  return nearest ? "; the nearest cell that can be one is " + text_of(*nearest) + " at " +
                       text_of(map.center_of(*nearest)) + "."
                 : "; no cell of this drawing can be one, so check the map.";
}

std::string percent(double share) { return text_of(100.0 * share, 0) + " %"; }

std::string word_of(ActionType type) {
  switch (type) {
    case ActionType::kMoveForward:
      return "forward";
    case ActionType::kTurnLeft:
      return "turning left";
    case ActionType::kTurnRight:
      return "turning right";
    case ActionType::kStop:
      break;
  }
  return "standing";
}

}  // namespace

Planner::Planner(CoarseMap map, const PlanningParams& params)
    : map_{std::move(map)}, params_{params}, policy_{make_policy(params)}, rng_{params.seed} {}

std::optional<std::string> Planner::set_goal(Point2 goal_map) {
  const std::string name = "Goal " + text_of(goal_map);
  if (!std::isfinite(goal_map.x) || !std::isfinite(goal_map.y)) {
    return name + " is not a point" + nearest_goal(map_, map_.T_map_grid().position());
  }
  // Compared as numbers first: a far away point has no cell that an int could name.
  const Point2 p_grid = inverse(map_.T_map_grid()) * goal_map;
  const double r = map_.resolution();
  if (p_grid.x < 0.0 || p_grid.y < 0.0 || p_grid.x >= map_.width() * r ||
      p_grid.y >= map_.height() * r || !map_.contains(map_.cell_of(goal_map))) {
    return name + " lies outside the drawing, which is " + text_of(map_.width() * r, 2) + " m x " +
           text_of(map_.height() * r, 2) + " m with its lower left corner at " +
           text_of(map_.T_map_grid().position()) + nearest_goal(map_, goal_map);
  }
  const Cell cell = map_.cell_of(goal_map);
  if (map_.is_occupied(cell)) {
    return name + " lies in cell " + text_of(cell) + ", which is occupied on the drawing" +
           nearest_goal(map_, goal_map);
  }
  if (!has_free_neighbour(map_, cell)) {
    return name + " lies in cell " + text_of(cell) + ", which is walled in on all four sides" +
           nearest_goal(map_, goal_map);
  }
  goal_ = cell;
  goal_cells_ = params_.policy == "belief" ? (1.0 / r) * p_grid : middle_of(cell);
  cost_to_go_ = CostToGo{map_, cell};
  actions_ = 0;
  pivots_ = 0;
  is_stuck_ = false;
  end_.reset();
  policy_->reset();
  return std::nullopt;
}

void Planner::cancel_goal() {
  goal_.reset();
  cost_to_go_ = CostToGo{};
  actions_ = 0;
  end_.reset();
  policy_->reset();
}

std::vector<Cell> Planner::path_from(Cell from) const { return cost_to_go_.path(from); }

bool Planner::is_at_goal(const Situation& situation) const {
  if (!situation.is_converged || situation.confidence < params_.reached_confidence) {
    return false;
  }
  const double cell_m = map_.resolution();
  const double straight_m = cell_m * norm(situation.position_cells - situation.goal_cells);
  const std::optional<double> own_m = policy_->distance_to_go_m(situation);
  // Without walls a path along the axes is at most sqrt(2) times the straight line, and a cell of
  // the map more.
  if (own_m) {
    return straight_m <= params_.goal_tolerance_m && *own_m <= 2.0 * params_.goal_tolerance_m &&
           policy_->is_as_near_as_can_be();
  }
  const Cell here = situation.estimate.cell;
  const double path_m = cost_to_go_(here) * cell_m;
  return here == *goal_ || (straight_m <= params_.goal_tolerance_m &&
                            path_m <= std::sqrt(2.0) * params_.goal_tolerance_m);
}

double Planner::reachable_mass(const Belief& belief) const {
  double mass = 0.0;
  for (std::size_t i = 0; i < map_.occupied().size(); ++i) {
    const Cell c = map_.occupied().cell_at(i);
    if (cost_to_go_.is_reachable(c)) {
      for (const Heading h : kHeadings) {
        mass += belief(h, c);
      }
    }
  }
  return mass;
}

Decision Planner::end(NavigationState state, double distance_m, std::string text) {
  end_ = Decision{state, Action{}, distance_m, std::move(text)};
  return *end_;
}

Decision Planner::look_round(double axes_yaw_rad) {
  if (!goal_) {
    return resting(NavigationState::kStopped, "No goal is set.");
  }
  if (end_) {
    return *end_;
  }
  ++pivots_;
  is_pivoting_ = true;
  return {NavigationState::kLocalizing,
          {ActionType::kTurnLeft, 0.0, axes_yaw_rad},
          std::numeric_limits<double>::quiet_NaN(),
          "Looking round, turning left.",
          true};
}

Decision Planner::decide(const Localization& localization, bool is_blocked_ahead,
                         const LocalOccupancy* local_map) {
  is_pivoting_ = false;
  if (!goal_) {
    return resting(NavigationState::kStopped, "No goal is set.");
  }
  if (end_) {
    return *end_;
  }
  const Cell here = localization.estimate.cell;
  const Situation situation{map_,
                            localization.belief,
                            cost_to_go_,
                            localization.estimate,
                            localization.position_cells,
                            localization.yaw_rad,
                            goal_cells_,
                            localization.confidence,
                            localization.is_converged,
                            is_blocked_ahead || is_stuck_,
                            is_stuck_,
                            localization.scale,
                            localization.axes_yaw_rad,
                            local_map,
                            localization.possible,
                            localization.looks};
  policy_->look(situation);
  const std::optional<double> own_m = policy_->distance_to_go_m(situation);
  const double distance_m = own_m                            ? *own_m
                            : cost_to_go_.is_reachable(here) ? cost_to_go_(here) * map_.resolution()
                                                             : std::nan("");
  if (is_at_goal(situation)) {
    return end(NavigationState::kReached, distance_m,
               "Reached the goal at cell " + text_of(*goal_) + " with " + std::to_string(actions_) +
                   " actions, confidence " + percent(localization.confidence) + ".");
  }
  if (localization.is_converged && std::isnan(distance_m) &&
      reachable_mass(localization.belief) < kNegligibleMass) {
    return end(NavigationState::kFailed, distance_m,
               "No way on the drawing leads to the goal at cell " + text_of(*goal_) +
                   " from wherever the robot may be; it is most probably at cell " + text_of(here) +
                   ".");
  }
  if (actions_ >= params_.max_actions) {
    return end(NavigationState::kFailed, distance_m,
               "Gave up after " + std::to_string(actions_) + " actions (max_actions)" +
                   (std::isnan(distance_m)
                        ? std::string{"."}
                        : ", by the estimate " + text_of(distance_m, 1) + " m before the goal."));
  }
  return act(situation, distance_m);
}

Decision Planner::act(const Situation& situation, double distance_m) {
  Decision decision;
  decision.distance_to_go_m = distance_m;
  decision.action.type = policy_->choose(situation, rng_);
  if (decision.action.type == ActionType::kMoveForward) {
    decision.action.distance_m = params_.step_m;
  }
  decision.action.axes_yaw_rad = situation.axes_yaw_rad;
  last_action_ = decision.action.type;
  ++actions_;

  const std::string doing = word_of(decision.action.type) +
                            (situation.is_blocked_ahead ? ", the way ahead is blocked." : ".");
  if (!situation.is_converged) {
    decision.state = NavigationState::kLocalizing;
    decision.text = "Looking for its place on the drawing (confidence " +
                    percent(situation.confidence) + "), " + doing;
  } else if (std::isnan(distance_m)) {
    decision.state = NavigationState::kLocalizing;
    decision.text = "Exploring, since no way leads to the goal from the estimate at cell " +
                    text_of(situation.estimate.cell) + ", " + doing;
  } else {
    decision.state = NavigationState::kNavigating;
    decision.text = text_of(distance_m, 1) + " m to go, " + doing;
  }
  return decision;
}

}  // namespace cmn
