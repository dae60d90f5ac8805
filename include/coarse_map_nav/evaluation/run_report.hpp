// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a journey leaves behind: run.png, run.gif, summary.json.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/evaluation/run_goal.hpp"
#include "coarse_map_nav/evaluation/run_record.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace cmn {

/// What was tried, and what came of it.
struct RunOutcome {
  std::string world;  ///< file
  std::string map;    ///< file
  std::string robot;
  std::string preset;
  std::uint32_t seed = 0;
  RunGoal goal;
  std::string state;  ///< REACHED, FAILED or STOPPED
  std::string reason;
  std::uint32_t actions = 0;
  int collisions = 0;
  double wall_time_s = 0.0;
  std::optional<Pose2> T_world_end;  ///< the truth

  bool is_reached() const { return state == "REACHED"; }
  /// How far from the goal it really stands [m], where both are known.
  std::optional<double> true_distance_m() const;
};

/// The summary as a JSON object: all that is in the outcome, and reached, start, sim_time_s,
/// driven_m, true_distance_to_goal_m, localized. What is not known is null.
std::string summary_json(const RunRecord& record, const RunOutcome& outcome);

/// Writes all three into a folder, which is made where needed; the pictures only when there is a
/// belief to show. summary.json comes last and at once: where it is, all is. Throws
/// std::runtime_error naming the file that cannot be written.
void write_run_report(const std::string& folder, const RunSetting& setting, const RunRecord& record,
                      const RunOutcome& outcome);

}  // namespace cmn
