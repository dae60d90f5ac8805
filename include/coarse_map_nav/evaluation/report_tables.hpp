// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The tables of an evaluation's report, in Markdown, each with an empty line after it.
#pragma once

#include "coarse_map_nav/evaluation/episode_group.hpp"
#include "coarse_map_nav/evaluation/table_text.hpp"

#include <string>
#include <vector>

namespace cmn {

/// A method a row: N, SR and SPL with 95 % intervals, what the robot itself declared, what it
/// did for that. Preceded by a warning when methods have not all run the same episodes.
std::string success_table(const EpisodeTable& table);
/// A method a row: convergence, actions, collisions, time.
std::string cost_table(const EpisodeTable& table);
/// A method a row, a building a column: SR / SPL.
std::string building_table(const EpisodeTable& table);
/// A method a row: of the episodes with a kidnapping, how many found out where they were and after
/// how many actions; empty when there are none.
std::string kidnap_table(const EpisodeTable& table);
/// A method a row: how well what it saw agrees with what was in sight; empty when nobody knows.
std::string sight_table(const EpisodeTable& table);
/// The first method against each other one, on the episodes that both have run; empty for one.
std::string paired_table(const EpisodeTable& table);
/// SR / SPL of the CMN paper beside those of all tables of one task; empty when it has none.
std::string paper_table(const std::vector<EpisodeTable>& tables);

}  // namespace cmn
