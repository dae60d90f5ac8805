// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Who says how an episode went: knows the truth, and fills in the row.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/localization.hpp"
#include "coarse_map_nav/evaluation/episode_row.hpp"
#include "coarse_map_nav/evaluation/route_sampler.hpp"
#include "coarse_map_nav/simulation/simulator.hpp"
#include "coarse_map_nav/simulation/step_drive.hpp"

#include <cstdint>
#include <optional>

namespace cmn {

/// When a robot is carried elsewhere, and when it counts as having found out.
struct KidnapParams {
  int right_looks = 5;       ///< converged to the right place for so many looks in a row ...
  int latest_actions = 100;  ///< ... or, when that never comes, after so many actions ...
  double near_goal_m = 2.0;  ///< ... or this near to the goal: there is still a way to go
  double least_away_m = 3.0;
  int hold_looks = 5;  ///< right again: for so many looks in a row, or until the end
};

struct JudgeParams {
  double success_radius_m = 0.4;   ///< CMN's released parameters
  double declared_radius_m = 1.0;  ///< of a REACHED that counts as right
  /// From here on a belief counts as converged, whatever the method itself makes of it: some act on
  /// their estimate from the first step on.
  double converged_confidence = 0.5;
  double least_way_m = 3.0;
  double most_way_m = 20.0;
  /// Of worlds with heights: what stands lower than this is in the robot's way, and drawn.
  /// DepthParams takes the same for an obstacle: the LoCoBot of 0.6 m does not drive under tables.
  double robot_height_m = 0.8;
  bool papers_robot_slides = true;
  bool papers_robot_knows_heading = true;
  bool counts_commanded_way = false;
  bool forgets_at_goal = false;
  KidnapParams kidnap;
  SimulationParams simulation;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("success_radius_m", self.success_radius_m, Between{0.05, 10.0},
          "[m] success: this near to the goal");
    visit("least_way_m", self.least_way_m, Between{0.1, 1000.0}, "[m] from start to goal");
    visit("most_way_m", self.most_way_m, Between{0.1, 1000.0}, "[m] from start to goal");
    visit("robot_height_m", self.robot_height_m, Between{0.05, 2.5},
          "[m] in a world with heights what stands lower stops the robot, and is drawn");
    visit("papers_robot_slides", self.papers_robot_slides, Anything{},
          "in the CMN paper's own setting (CG) the robot slides along walls, whatever "
          "simulation/robot/sliding says");
    visit(
        "papers_robot_knows_heading", self.papers_robot_knows_heading, Anything{},
        "in CI and HD the odometry has the true heading at every step, as the CMN paper's robot is "
        "told it; false: at the start alone, and the turns of panoramas let it drift");
    visit("counts_commanded_way", self.counts_commanded_way, Anything{},
          "the way driven is that of all forward actions, also of those that a wall ended, as in "
          "CMN's released code");
    visit("forgets_at_goal", self.forgets_at_goal, Anything{},
          "who goes on at what it takes for the goal (cmn, mcse, rmn) starts over with its belief, "
          "as in CMN's released code");
    visit.group("simulation", self.simulation);
  }
};

/// Where a kidnapped robot is put down: uniform over the places from where the way to the goal is
/// `least_way_m` to `most_way_m` long and that are `least_away_m` from where it stands; anywhere
/// 1.5 m away in a world too small for that. Draws depend on the seed and the goal alone, so that
/// nearly always all methods are put down at the same place. None: the world is smaller still.
std::optional<Route> sample_drop(const RouteSampler& routes, const JudgeParams& params,
                                 const Pose2& T_world_robot, Point2 goal_world, std::uint64_t seed);

/// Fills in what is seen at the start and after each action.
class Judge {
 public:
  /// `kidnaps`: everything that is to be achieved counts from the drop on.
  Judge(const JudgeParams& params, const Route& route, const EpisodeKey& key, bool kidnaps);

  /// Where the robot has come to.
  void look_at(const StepDrive& robot);
  /// What is believed, and where that is in truth, both on `map`. `is_stated`: it is the method's
  /// own belief, and not the truth that it was told.
  void look_at(const Localization& at, const CoarseMap& map, const Pose2& T_map_true,
               bool is_stated);
  /// The robot says that it has arrived; the first word counts.
  void hear_reached(const StepDrive& robot);
  /// One that took so long.
  void count_action(const Action& action, double duration_s);
  void count_pivot(double duration_s);

  /// The robot is to be kidnapped before the next look; at any end that it declares before.
  bool is_time_to_kidnap(const StepDrive& robot) const;
  bool is_before_drop() const { return kidnaps_ && row_.drop_actions < 0; }
  void drop(StepDrive& robot, const Route& from_there);
  /// There is nowhere to carry it to.
  void give_up_kidnapping() { kidnaps_ = false; }
  /// Nothing more is to come.
  void end();

  EpisodeRow& row() { return row_; }

 private:
  double off_goal_m(const StepDrive& robot) const;
  double driven_m(const StepDrive& robot) const {
    return params_.counts_commanded_way ? commanded_m_ : robot.driven_m();
  }

  JudgeParams params_;
  bool kidnaps_;
  EpisodeRow row_;
  double commanded_m_ = 0.0;
  int right_looks_ = 0;  ///< in a row, converged
  int right_since_ = 0;  ///< [actions] the first of them
};

}  // namespace cmn
