// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What an evaluation leaves behind: report.md, its plots, and the last lines on the terminal.
#pragma once

#include "coarse_map_nav/evaluation/episode_row.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cmn {

/// How the episodes were made, as far as the report has to say it.
struct ReportContext {
  std::string command;  ///< the line that makes them again
  std::string machine;  ///< empty: not said
  std::string version;  ///< of the package; empty: not said
  std::uint64_t seed = 0;
  double robot_radius_m = 0.18;
  double success_radius_m = 0.4;
  int horizon = 500;            ///< [actions] at most
  double wall_time_s = 0.0;     ///< of the whole run; 0: not said
  bool is_interrupted = false;  ///< these are not all episodes that were asked for
  std::vector<std::pair<std::string, std::string>> settings;  ///< whatever else, name and value
};

/// One of "RESULT task=CL mpp=0.40 method=ours SR=0.820 SPL=0.640 episodes=50" per task, resolution
/// and method, in the order of episode_group.hpp, pooled over all worlds. Without line ends.
std::vector<std::string> result_lines(const std::vector<EpisodeRow>& rows);

/// The files of a report and what is in them: report.md and per task success_TASK.svg,
/// bars_TASK.svg, buildings_TASK.svg and, when a belief ever converged, convergence_TASK.svg.
std::map<std::string, std::string> report_files(const std::vector<EpisodeRow>& rows,
                                                const ReportContext& context);

/// Writes them into a folder, which is made where needed. Throws std::runtime_error naming the
/// file that cannot be written.
void write_report(const std::vector<EpisodeRow>& rows, const ReportContext& context,
                  const std::string& folder);

}  // namespace cmn
