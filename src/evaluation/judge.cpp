// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/judge.hpp"

#include "coarse_map_nav/evaluation/localization_error.hpp"

#include <algorithm>
#include <random>

namespace cmn {

std::optional<Route> sample_drop(const RouteSampler& routes, const JudgeParams& params,
                                 const Pose2& T_world_robot, Point2 goal_world,
                                 std::uint64_t seed) {
  constexpr double kFarthest_m = 1e4;
  constexpr double kAnywhereElse_m = 1.5;
  std::mt19937_64 rng{seed};
  const auto is_away = [&](double least_m) {
    return [&, least_m](Point2 p) { return norm(p - T_world_robot.position()) >= least_m; };
  };
  const auto there = routes.sample_to(goal_world, params.least_way_m, params.most_way_m,
                                      is_away(params.kidnap.least_away_m), rng);
  return there ? there
               : routes.sample_to(goal_world, 0.0, kFarthest_m, is_away(kAnywhereElse_m), rng);
}

Judge::Judge(const JudgeParams& params, const Route& route, const EpisodeKey& key, bool kidnaps)
    : params_{params}, kidnaps_{kidnaps} {
  row_.key = key;
  row_.T_world_start = route.T_world_start;
  row_.goal_world = route.goal_world;
  row_.shortest_m = route.shortest_m;
  row_.closest_m = norm(route.T_world_start.position() - route.goal_world);
}

double Judge::off_goal_m(const StepDrive& robot) const {
  return norm(robot.truth().position() - row_.goal_world);
}

void Judge::look_at(const StepDrive& robot) {
  row_.driven_m = driven_m(robot);
  row_.collisions = robot.collisions();
  if (is_before_drop()) {
    return;
  }
  const double off_m = off_goal_m(robot);
  row_.closest_m = std::min(row_.closest_m, off_m);
  if (!row_.is_success && off_m < params_.success_radius_m) {
    row_.is_success = true;
    row_.success_driven_m = row_.driven_m;
    row_.success_actions = row_.actions;
  }
}

void Judge::look_at(const Localization& at, const CoarseMap& map, const Pose2& T_map_true,
                    bool is_stated) {
  const double off_m = norm(map.center_of(at.estimate.cell) - T_map_true.position());
  const Heading heading = nearest_heading(T_map_true.yaw - map.T_map_grid().yaw);
  const bool is_right = off_m <= kRightWithin_m && at.estimate.heading == heading;
  if (is_stated) {
    row_.confidence.add(at.confidence, is_right);
  }
  const bool is_converged = at.is_converged && at.confidence >= params_.converged_confidence;
  if (is_converged && row_.converged_actions < 0) {
    row_.converged_actions = row_.actions;
    row_.converged_driven_m = row_.driven_m;
    row_.is_falsely_converged = !is_right;
  }
  if (!is_converged || !is_right) {
    right_looks_ = 0;
    return;
  }
  right_since_ = right_looks_ == 0 ? row_.actions : right_since_;
  ++right_looks_;
  if (row_.drop_actions >= 0 && row_.recovered_actions < 0 &&
      right_looks_ >= params_.kidnap.hold_looks) {
    row_.recovered_actions = right_since_ - row_.drop_actions;
  }
}

void Judge::count_action(const Action& action, double duration_s) {
  ++row_.actions;
  row_.simulated_s += duration_s;
  commanded_m_ += action.type == ActionType::kMoveForward ? action.distance_m : 0.0;
}

void Judge::count_pivot(double duration_s) {
  ++row_.pivots;
  row_.simulated_s += duration_s;
}

void Judge::hear_reached(const StepDrive& robot) {
  if (!row_.is_declared && !is_before_drop()) {
    row_.is_declared = true;
    row_.is_declared_right = off_goal_m(robot) <= params_.declared_radius_m;
  }
}

bool Judge::is_time_to_kidnap(const StepDrive& robot) const {
  return is_before_drop() && (right_looks_ >= params_.kidnap.right_looks ||
                              row_.actions >= params_.kidnap.latest_actions ||
                              off_goal_m(robot) < params_.kidnap.near_goal_m);
}

void Judge::drop(StepDrive& robot, const Route& from_there) {
  robot.set_truth(from_there.T_world_start);
  row_.drop_actions = row_.actions;
  row_.T_world_drop = from_there.T_world_start;
  row_.drop_driven_m = driven_m(robot);
  row_.drop_shortest_m = from_there.shortest_m;
  row_.closest_m = off_goal_m(robot);
  right_looks_ = 0;
}

void Judge::end() {
  if (row_.drop_actions >= 0 && row_.recovered_actions < 0 && right_looks_ > 0) {
    row_.recovered_actions = right_since_ - row_.drop_actions;
  }
}

}  // namespace cmn
