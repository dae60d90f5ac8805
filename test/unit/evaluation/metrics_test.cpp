// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fake_episodes.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

void expect_figure(const Figure& figure, double value, double low, double high, double within) {
  EXPECT_NEAR(figure.value, value, within);
  EXPECT_NEAR(figure.low, low, within);
  EXPECT_NEAR(figure.high, high, within);
}

TEST(WilsonShare, IsThatOfNewcombesTable) {
  // Newcombe (1998), table I, method 3.
  expect_figure(wilson_share(81, 263), 81.0 / 263.0, 0.2553, 0.3662, 5e-5);
  expect_figure(wilson_share(15, 148), 15.0 / 148.0, 0.0624, 0.1605, 5e-5);
  expect_figure(wilson_share(0, 20), 0.0, 0.0000, 0.1611, 5e-5);
  expect_figure(wilson_share(1, 29), 1.0 / 29.0, 0.0061, 0.1718, 5e-5);
}

TEST(WilsonShare, IsTheSameForFailures) {
  const Figure successes = wilson_share(15, 148);
  const Figure failures = wilson_share(133, 148);
  expect_figure(failures, 1.0 - successes.value, 1.0 - successes.high, 1.0 - successes.low, 1e-12);
}

TEST(WilsonShare, StaysWithinZeroAndOne) {
  for (int n = 1; n < 200; ++n) {
    EXPECT_EQ(wilson_share(0, n).low, 0.0);
    EXPECT_EQ(wilson_share(n, n).high, 1.0);
  }
  EXPECT_TRUE(std::isnan(wilson_share(0, 0).value));
}

TEST(BootstrapMean, OfManyIsTheNormalInterval) {
  std::vector<double> values(400, 0.0);
  std::fill(values.begin(), values.begin() + 200, 1.0);
  // Standard error 0.5 / sqrt(400) = 0.025.
  expect_figure(bootstrap_mean(values), 0.5, 0.5 - 1.96 * 0.025, 0.5 + 1.96 * 0.025, 0.004);
}

TEST(BootstrapMean, OfEqualValuesIsThatValue) {
  expect_figure(bootstrap_mean({0.25, 0.25, 0.25}), 0.25, 0.25, 0.25, 0.0);
  expect_figure(bootstrap_mean({0.5}), 0.5, 0.5, 0.5, 0.0);
  EXPECT_TRUE(std::isnan(bootstrap_mean({}).value));
}

TEST(BootstrapMean, DependsNeitherOnOrderNorOnTheCall) {
  const Figure once = bootstrap_mean({0.1, 0.9, 0.4, 0.0, 0.7});
  const Figure again = bootstrap_mean({0.7, 0.0, 0.1, 0.4, 0.9});
  EXPECT_EQ(once.value, again.value);
  EXPECT_EQ(once.low, again.low);
  EXPECT_EQ(once.high, again.high);
}

TEST(Median, IsTheMiddleOne) {
  EXPECT_EQ(median({5.0, 1.0, 3.0}), 3.0);
  EXPECT_EQ(median({1.0, 2.0, 4.0, 9.0}), 3.0);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(Metrics, AreThoseWorkedByHand) {
  EpisodeRow a = successful_episode(4.0, 5.0);  // SPL 0.8, 33 actions
  a.is_declared = a.is_declared_right = true;
  a.converged_actions = 10;
  a.converged_driven_m = 1.5;
  a.actions = 10;
  a.step_ms = 2.0;
  EpisodeRow b = successful_episode(4.0, 3.7);  // SPL 1
  b.converged_actions = 30;
  b.converged_driven_m = 2.5;
  b.collisions = 2;
  b.actions = 30;
  b.step_ms = 4.0;
  EpisodeRow c = failed_episode();  // SPL 0
  c.driven_m = 11.3;
  c.is_declared = true;
  c.converged_actions = 35;
  c.converged_driven_m = 4.0;
  c.is_falsely_converged = true;
  c.collisions = 1;
  c.actions = 0;
  const Metrics metrics = metrics_of({a, b, c});
  EXPECT_EQ(metrics.episodes, 3);
  EXPECT_DOUBLE_EQ(metrics.success.value, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(metrics.spl.value, 0.6);
  EXPECT_LE(metrics.spl.low, 0.6);
  EXPECT_GE(metrics.spl.high, 0.6);
  EXPECT_DOUBLE_EQ(metrics.declared_right.value, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(metrics.declared_wrong.value, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(metrics.converged.value, 1.0);
  EXPECT_DOUBLE_EQ(metrics.falsely_converged.value, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(metrics.median_converged_actions, 30.0);
  EXPECT_DOUBLE_EQ(metrics.median_converged_driven_m, 2.5);
  EXPECT_DOUBLE_EQ(metrics.collisions_per_100_m, 15.0);  // 3 in 20 m
  EXPECT_DOUBLE_EQ(metrics.mean_actions, 40.0 / 3.0);
  EXPECT_DOUBLE_EQ(metrics.step_ms, 3.5);  // (10 * 2 + 30 * 4) / 40
}

TEST(Metrics, OfWhatNeverHappenedAreNoNumbers) {
  EXPECT_TRUE(std::isnan(metrics_of({}).success.value));
  const Metrics metrics = metrics_of({failed_episode()});
  EXPECT_EQ(metrics.success.value, 0.0);
  EXPECT_EQ(metrics.converged.value, 0.0);
  EXPECT_TRUE(std::isnan(metrics.falsely_converged.value));
  EXPECT_TRUE(std::isnan(metrics.median_converged_actions));
  EpisodeRow still = failed_episode();
  still.driven_m = 0.0;
  EXPECT_TRUE(std::isnan(metrics_of({still}).collisions_per_100_m));
}

TEST(PairedSuccess, CountsTheEpisodesInWhichMethodsDiffer) {
  std::vector<EpisodeRow> ours;
  std::vector<EpisodeRow> cmn;
  for (int i = 0; i < 10; ++i) {  // 0: both; 1: CMN alone; 2..8: ours alone; 9: neither
    const bool ours_succeeds = i == 0 || (i >= 2 && i <= 8);
    ours.push_back(ours_succeeds ? successful_episode(4, 5, "ours", i) : failed_episode("ours", i));
    cmn.push_back(i <= 1 ? successful_episode(4, 5, "cmn", i) : failed_episode("cmn", i));
  }
  ours.push_back(failed_episode("ours", 77));  // CMN has not run it
  const PairedSuccess pairs = paired_success(ours, cmn);
  EXPECT_EQ(pairs.episodes, 10);
  EXPECT_EQ(pairs.only_first, 7);
  EXPECT_EQ(pairs.only_second, 1);
  EXPECT_EQ(pairs.both, 1);
  EXPECT_DOUBLE_EQ(pairs.difference.value, 0.6);
  EXPECT_NEAR(pairs.spl_difference.value, 0.48, 1e-12);
  EXPECT_NEAR(pairs.p_value, 2.0 * 9.0 / 256.0, 1e-12);  // at most one head in eight tosses
  EXPECT_EQ(paired_success(ours, ours).p_value, 1.0);
}

TEST(PairedDifference, HasTheIntervalThatNewcombePrints) {
  // Newcombe (1998), Statistics in Medicine 17, 2635-2650, table II: 36, 12, 2, 0 and 20, 12,
  // 2, 16.
  const Figure high = paired_difference(36, 12, 2, 0);
  EXPECT_DOUBLE_EQ(high.value, 0.2);
  EXPECT_NEAR(high.low, 0.0569, 1e-4);
  EXPECT_NEAR(high.high, 0.3404, 1e-4);
  const Figure middle = paired_difference(20, 12, 2, 16);
  EXPECT_NEAR(middle.low, 0.0562, 1e-4);
  EXPECT_NEAR(middle.high, 0.3292, 1e-4);
}

TEST(PairedDifference, TurnsItsSignWithTheOrderAndHoldsItsValue) {
  for (int both = 0; both <= 6; both += 2) {
    for (int first = 0; first <= 6; first += 3) {
      for (int second = 0; second <= 6; second += 3) {
        const Figure one = paired_difference(both, first, second, 5);
        const Figure other = paired_difference(both, second, first, 5);
        EXPECT_NEAR(one.value, -other.value, 1e-12);
        EXPECT_NEAR(one.low, -other.high, 1e-12);
        EXPECT_LE(one.low, one.value);
        EXPECT_GE(one.high, one.value);
        EXPECT_GE(one.low, -1.0);
        EXPECT_LE(one.high, 1.0);
      }
    }
  }
  EXPECT_TRUE(std::isnan(paired_difference(0, 0, 0, 0).value));
}

TEST(Metrics, OfKidnappedRobotsCountThoseThatNeverRecoveredAsLast) {
  std::vector<EpisodeRow> rows(5, successful_episode(4.0, 9.0));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].drop_actions = 10;
    rows[i].recovered_actions = i < 3 ? static_cast<int>(10 * i) : -1;
  }
  Metrics metrics = metrics_of(rows);
  EXPECT_EQ(metrics.kidnapped, 5);
  EXPECT_DOUBLE_EQ(metrics.recovered.value, 0.6);
  EXPECT_DOUBLE_EQ(metrics.median_recovered_actions, 20.0);
  rows[2].recovered_actions = -1;
  EXPECT_TRUE(std::isnan(metrics_of(rows).median_recovered_actions));
  EXPECT_EQ(metrics_of({failed_episode()}).kidnapped, 0);
}

}  // namespace
}  // namespace cmn
