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

/// Runs one episode again; `key` as episode_seed() makes it, its method among the plan's; what
/// replay() says of the actions `explained`. Throws std::runtime_error when it has no route, or the
/// plan no world that is called as that of the key.
Recording run_again(const Plan& plan, Worlds& worlds, EpisodeKey key,
                    const std::vector<int>& explained = {});

/// The rows of a run. Throws std::runtime_error when there are none.
std::vector<EpisodeRow> rows_in(const std::filesystem::path& folder);

/// Throws std::runtime_error naming the file that cannot be written; prints its name.
void write_picture(const std::filesystem::path& path, const cv::Mat& picture);

/// Runs episodes by their ids and leaves ID.png, ID.gif and, of several methods on one episode,
/// TASK-MPP-WORLD-INDEX.png in `plan.out`. Of the plan it takes worlds, seed, presets and judge.
/// Prints each row, and in what it differs from that in episodes.csv there, if any.
/// Before each of the actions `explained`, counted from 0, ID_action_K.png takes the moment apart,
/// and the folder of that name holds its panels one by one.
/// Throws std::runtime_error or std::invalid_argument naming what cannot be done.
void replay(const Plan& plan, const std::vector<std::string>& ids,
            const std::vector<int>& explained);

}  // namespace cmn
