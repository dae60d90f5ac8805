// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What an evaluation leaves behind: report.md, its plots, and the last lines on the terminal.
#pragma once

#include "coarse_map_nav/evaluation/episode_row.hpp"
#include "coarse_map_nav/evaluation/report_context.hpp"

#include <map>
#include <string>
#include <vector>

namespace cmn {

/// One of "RESULT task=CL mpp=0.40 method=ours SR=0.820 SPL=0.640 episodes=50" per task, resolution
/// and method, in the order of episode_group.hpp, pooled over all worlds; of kidnapped robots
/// followed by " recovered=0.950 median_actions=20". Without line ends.
std::vector<std::string> result_lines(const std::vector<EpisodeRow>& rows);

/// The files of a report and what is in them: report.md and per task success_TASK.svg,
/// bars_TASK.svg, buildings_TASK.svg and, when a belief ever converged, convergence_TASK.svg; when
/// one stated its confidence, reliability_TASK.svg; when there are variants, ablation_TASK.svg.
/// Episodes without a route are named, and in no table.
std::map<std::string, std::string> report_files(const std::vector<EpisodeRow>& all_rows,
                                                const ReportContext& context);

/// Writes them into a folder, which is made where needed. Throws std::runtime_error naming the
/// file that cannot be written.
void write_report(const std::vector<EpisodeRow>& rows, const ReportContext& context,
                  const std::string& folder);

}  // namespace cmn
