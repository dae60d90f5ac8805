// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One judged episode as a row of episodes.csv.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/evaluation/confidence_bins.hpp"

#include <cstdint>
#include <iosfwd>
#include <limits>
#include <string>
#include <vector>

namespace cmn {

/// What names an episode; all that a replay needs beside the worlds and the options of the run.
struct EpisodeKey {
  std::string task;   ///< CG, CL, CD, CF, HL, WL, ..., and CLK to WLK
  std::string world;  ///< name of a building, house:SEED or furnished:SEED
  double mpp = 0.4;   ///< [m/cell] of the drawing
  std::string method;
  int index = 0;           ///< of the episode in this world, from 0
  std::uint64_t seed = 0;  ///< of start, goal and all noise: the same for every method

  /// "CL-0.40-intel-17-ours": as --replay takes it.
  std::string id() const;
};
/// The key of an id, its seed 0. Worlds may have dashes in their names. Throws
/// std::invalid_argument when it is no id.
EpisodeKey parse_episode_id(const std::string& id);
/// Order of the report: task, mpp, world, index, method.
bool operator<(const EpisodeKey& a, const EpisodeKey& b);
bool operator==(const EpisodeKey& a, const EpisodeKey& b);

/// What came of it. NaN or -1 where something never happened.
struct EpisodeRow {
  static constexpr double kNever = std::numeric_limits<double>::quiet_NaN();

  EpisodeKey key;
  Pose2 T_world_start;
  Point2 goal_world;
  double shortest_m = 0.0;  ///< l of SPL: shortest way of a disc of the robot's radius

  bool is_success = false;           ///< judged: came within 0.4 m of the goal
  double success_driven_m = kNever;  ///< p of SPL: driven until then
  int success_actions = -1;
  bool is_declared = false;        ///< the robot itself said REACHED ...
  bool is_declared_right = false;  ///< ... within 1 m of the goal
  int actions = 0;                 ///< all of the episode
  int pivots = 0;                  ///< turns of panoramas, not among the actions
  double driven_m = 0.0;
  double simulated_s = 0.0;    ///< that the robot moved for, pivots included
  int converged_actions = -1;  ///< first convergence of the belief
  double converged_driven_m = kNever;
  bool is_falsely_converged = false;  ///< then, by more than 1 m or a quarter turn
  int collisions = 0;
  double closest_m = kNever;  ///< to the goal, ever
  /// Of what was seen with that in sight, see sight_score.hpp; in worlds with heights alone.
  double free_iou = kNever;
  double obstacle_iou = kNever;
  double step_ms = 0.0;  ///< mean wall time of see + believe + plan; not reproducible
  std::string end;       ///< reached, failed, horizon, success (the judge's), goal refused,
                         ///< no route

  ConfidenceBins confidence;  ///< of all looks, but of a method that is told its pose

  // Of an episode in which the robot is kidnapped: success and declaration count from then on.
  int drop_actions = -1;  ///< done before
  Pose2 T_world_drop{kNever, kNever, kNever};
  double drop_driven_m = kNever;    ///< before
  double drop_shortest_m = kNever;  ///< l of SPL: from there
  /// After the drop, until the belief had converged to the right place and stayed.
  int recovered_actions = -1;

  /// S * l / max(l, p) (Anderson et al. 2018, "On Evaluation of Embodied Navigation Agents"); of a
  /// kidnapped robot from the drop on.
  double spl() const;
};

/// The header line of episodes.csv and one line a row, without line ends.
std::string csv_header();
std::string csv_line(const EpisodeRow& row);
/// Throws std::runtime_error naming `name`, line and fault. A last line without its end (an
/// interrupted run) is left out.
std::vector<EpisodeRow> read_episodes(std::istream& in, const std::string& name);

/// All rows of several runs, sorted, each episode once. The same episode may occur in several of
/// them when it came out the same (step_ms aside). Throws std::runtime_error naming up to ten
/// episodes that differ and in what.
std::vector<EpisodeRow> merge_episodes(const std::vector<std::vector<EpisodeRow>>& runs);

}  // namespace cmn
