// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether a stated confidence means what it says.
#pragma once

#include "coarse_map_nav/evaluation/confidence_bins.hpp"
#include "coarse_map_nav/evaluation/episode_group.hpp"
#include "coarse_map_nav/evaluation/metrics.hpp"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace cmn {

/// Looks of one bin of confidence, of all episodes together.
struct ReliabilityBin {
  int looks = 0;
  double stated = std::numeric_limits<double>::quiet_NaN();  ///< mean confidence
  Figure right;  ///< share that was right; its interval is over episodes, not looks
};

/// Confidence against being right: within 1 m and at the right quarter turn.
struct Reliability {
  int looks = 0;
  std::array<ReliabilityBin, ConfidenceBins::kCount> bins;
  /// Expected calibration error: the mean over all looks of |stated - right| of their bin (Naeini
  /// et al. 2015), with its bootstrap interval over episodes; NaN without looks.
  Figure calibration_error;
};

/// Intervals are percentile bootstraps of 1000 resamples of the episodes: looks of one episode are
/// far from independent. The same for the same rows in any order.
Reliability reliability_of(const std::vector<EpisodeRow>& rows);

/// A method a row: looks, calibration error, and of each bin "right % (looks)"; empty when no
/// method has stated a confidence.
std::string reliability_table(const EpisodeTable& table);

/// The reliability diagram of one task, a panel for each resolution: stated confidence against the
/// share that was right, with 95 % intervals; the area of a dot grows with its share of the looks.
/// Empty when no method has stated a confidence.
std::string reliability_plot(const std::vector<EpisodeTable>& tables);

}  // namespace cmn
