// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One line on a terminal that says how far a run is.
#pragma once

#include "coarse_map_nav/evaluation/episode_row.hpp"

#include <cstddef>
#include <string>

namespace cmn {

struct Progress {
  std::size_t done = 0;  ///< episodes, those of an earlier run included
  std::size_t total = 0;
  std::size_t done_before = 0;  ///< by that earlier run: they say nothing about the speed
  double elapsed_s = 0.0;       ///< of this run
  double success_share = EpisodeRow::kNever;  ///< so far; NaN: not shown
};

/// "[########------------]  40 %  48/120  SR 0.81  5.2/s  14 s left", at most 79 characters,
/// without a line end. No estimate before the first episode.
std::string progress_line(const Progress& progress);

}  // namespace cmn
