// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Judged episodes sorted into the rows and columns of tables, always in the same order.
#pragma once

#include "coarse_map_nav/evaluation/episode_row.hpp"

#include <string>
#include <vector>

namespace cmn {

/// What a table is about: one task on drawings of one resolution.
struct EpisodeTable {
  std::string task;
  double mpp = 0.0;  ///< [m/cell]
  std::vector<EpisodeRow> rows;
};

/// All tables that have rows: tasks in the order CG, CI, HD, CL, CD, CF, HL, WL, then others by
/// name; within a task from the finest drawing to the coarsest.
std::vector<EpisodeTable> episode_tables(const std::vector<EpisodeRow>& rows);

/// The methods that occur: ours, cmn, robb, mcse, rmn, rnd, true_pose, oracle, then others by name;
/// variants after their base.
std::vector<std::string> methods_of(const std::vector<EpisodeRow>& rows);
std::vector<EpisodeRow> of_method(const std::vector<EpisodeRow>& rows, const std::string& method);

/// The method of which a method is a variant: rolling of rolling+no_map_repair; of others itself.
std::string base_method(const std::string& method);
/// Without variants; when there are only variants, those.
std::vector<EpisodeRow> without_variants(const std::vector<EpisodeRow>& rows);

/// What `end` says of an episode for which no start and goal were found. It belongs in no table.
constexpr const char* kNoRoute = "no route";
/// Those that were played.
std::vector<EpisodeRow> played(const std::vector<EpisodeRow>& rows);

/// The column of a world: its own name, all generated houses (house:SEED) together being "houses".
std::string building_of(const std::string& world);
/// Houses first, then by name.
std::vector<std::string> buildings_of(const std::vector<EpisodeRow>& rows);
std::vector<EpisodeRow> of_building(const std::vector<EpisodeRow>& rows,
                                    const std::string& building);

/// As it is printed in a paper: CMN, true pose.
std::string method_label(const std::string& method);
/// "CL: coarse-grid map, LiDAR 360 deg, unknown yaw"; of an unknown task its name alone.
std::string task_title(const std::string& task);

}  // namespace cmn
