// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The plots of an evaluation, as SVG: one picture a task, one panel for each map resolution.
#pragma once

#include "coarse_map_nav/evaluation/episode_group.hpp"

#include <string>
#include <vector>

namespace cmn {

// All take the tables of one task, at least one.

/// Share of episodes that had come to the goal by an action; right of it the final SR of each
/// method with its 95 % interval.
std::string success_plot(const std::vector<EpisodeTable>& tables, int horizon);

/// Share of episodes whose belief had converged by an action, to the right place (drawn through)
/// and to any (dotted), for methods that are not told the pose at the start. Empty when no such
/// belief ever converged.
std::string convergence_plot(const std::vector<EpisodeTable>& tables, int horizon);

/// SR above SPL: a bar with its 95 % interval for each method.
std::string bar_plot(const std::vector<EpisodeTable>& tables);

/// SPL of each method with its 95 % interval, building by building.
std::string building_plot(const std::vector<EpisodeTable>& tables);

}  // namespace cmn
