// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What many judged episodes say about a method.
#pragma once

#include "coarse_map_nav/evaluation/episode_row.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace cmn {

/// A figure of merit and its 95 % interval; NaN where there is nothing to take it from.
struct Figure {
  double value = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

/// The share of successes with the score interval of Wilson (1927), without continuity correction:
/// method 3 of Newcombe (1998), "Two-sided confidence intervals for the single proportion".
/// 0 <= successes <= trials.
Figure wilson_share(int successes, int trials);

/// The mean of `values` with the percentile bootstrap interval (Efron and Tibshirani 1993, ch. 13).
/// The same for the same values in any order. Cost: resamples * values.
Figure bootstrap_mean(std::vector<double> values, std::uint64_t seed = 1, int resamples = 2000);

/// The middle value, between two middle ones their mean; NaN for none.
double median(std::vector<double> values);

/// Figures of one method on a set of episodes. Intervals are over episodes, drawn from these very
/// buildings; how far buildings differ is seen only by setting them side by side.
struct Metrics {
  int episodes = 0;
  Figure success;  ///< SR: share that came within the success radius of the goal
  Figure spl;      ///< success weighted by path length
  /// Share of all episodes in which the robot said REACHED, within 1 m of the goal or elsewhere.
  Figure declared_right;
  Figure declared_wrong;
  Figure converged;  ///< share of all episodes in which the belief ever converged
  /// Share of those whose first convergence was off by more than 1 m or a quarter turn.
  Figure falsely_converged;
  double median_converged_actions = EpisodeRow::kNever;   ///< among those that converged
  double median_converged_driven_m = EpisodeRow::kNever;  ///< among those that converged
  double collisions_per_100_m = EpisodeRow::kNever;       ///< NaN when nothing was driven
  double mean_actions = EpisodeRow::kNever;
  double mean_pivots = EpisodeRow::kNever;
  double mean_simulated_s = EpisodeRow::kNever;
  double free_iou = EpisodeRow::kNever;  ///< mean of the episodes that have one
  double obstacle_iou = EpisodeRow::kNever;
  int kidnapped = 0;  ///< episodes in which the robot was carried elsewhere
  Figure recovered;   ///< share of those
  /// After the drop, those that never recovered counted as later than all; NaN when half did not.
  double median_recovered_actions = EpisodeRow::kNever;
  double step_ms = EpisodeRow::kNever;  ///< mean over all actions of all episodes
};

Metrics metrics_of(const std::vector<EpisodeRow>& rows);

/// The difference of two shares of the same trials: `both` succeeded in both, `only_first` ...;
/// with the interval of method 10 of Newcombe (1998), "Improved confidence intervals for the
/// difference between binomial proportions based on paired data".
Figure paired_difference(int both, int only_first, int only_second, int neither);

/// How often one method succeeded where another failed, on the same episodes.
struct PairedSuccess {
  int episodes = 0;  ///< that both have run
  int only_first = 0;
  int only_second = 0;
  int both = 0;
  Figure difference;      ///< SR of the first less that of the second
  Figure spl_difference;  ///< mean, with its bootstrap interval over episodes
  /// Two-sided exact sign test on the episodes in which they differ (McNemar 1947); 1 for none.
  double p_value = 1.0;
};

/// Episodes are the same when all of the key but the method is.
PairedSuccess paired_success(const std::vector<EpisodeRow>& first,
                             const std::vector<EpisodeRow>& second);

}  // namespace cmn
