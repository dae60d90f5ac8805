// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Single episodes once more, to be looked at.
#pragma once

#include "coarse_map_nav/evaluation/episode_trace.hpp"
#include "coarse_map_nav/evaluation/run_record.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include "evaluation.hpp"
#include <opencv2/core.hpp>

namespace cmn {

/// What is kept of an episode that is run again.
struct Recording {
  EpisodeTrace trace;
  RunSetting setting;
  RunRecord record;
};

/// Runs one episode again; `key` as episode_seed() makes it, its method among the plan's.
/// Throws std::runtime_error when it has no route.
Recording run_again(const Plan& plan, const Scene& scene, EpisodeKey key);

/// The world of the plan that is called as that of the key. Throws std::runtime_error without one.
std::string world_of(const Plan& plan, const EpisodeKey& key);

/// The rows of a run. Throws std::runtime_error when there are none.
std::vector<EpisodeRow> rows_in(const std::filesystem::path& folder);

/// Throws std::runtime_error naming the file that cannot be written; prints its name.
void write_picture(const std::filesystem::path& path, const cv::Mat& picture);

/// Runs episodes by their ids and leaves ID.png, ID.gif and, of several methods on one episode,
/// TASK-MPP-WORLD-INDEX.png in `plan.out`. Of the plan it takes worlds, seed, presets and judge.
/// Prints each row, and in what it differs from that in episodes.csv there, if any.
/// Throws std::runtime_error or std::invalid_argument naming what cannot be done.
void replay(const Plan& plan, const std::vector<std::string>& ids);

}  // namespace cmn
