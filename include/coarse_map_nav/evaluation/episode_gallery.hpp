// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The worst episodes of a method side by side, each with its cause.
#pragma once

#include "coarse_map_nav/evaluation/episode_trace.hpp"

#include <cstddef>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// Why an episode went as badly as it did, by what was recorded of it.
struct EpisodeCause {
  std::string kind;    ///< a few words, of a fixed list: docs/evaluation.md
  std::string detail;  ///< with the numbers of this episode
};

/// The first rule that holds, see docs/evaluation.md. `trace` has at least one step unless the goal
/// was refused.
EpisodeCause cause_of(const EpisodeTrace& trace);

/// Up to `count` of them: failures first, the farthest from the goal before the nearer, then by
/// their SPL, then by their keys. Episodes without a route are no episodes.
std::vector<EpisodeRow> worst_episodes(const std::vector<EpisodeRow>& rows, std::size_t count);

/// A row of a table in Markdown for each, with links to ID.png where there is a step.
std::string gallery_table(const std::vector<EpisodeTrace>& traces);

/// All pictures on one sheet, two in a row, each with its cause above. 8-bit BGR. Throws
/// std::invalid_argument when no episode has a step.
cv::Mat gallery_sheet(const std::vector<EpisodeTrace>& traces);

/// The id of an episode as a name that every file system takes.
std::string file_name_of(const EpisodeKey& key);

}  // namespace cmn
