// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/reliability.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fake_episodes.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using ::testing::HasSubstr;

/// An episode with `right` of `looks` looks right at one confidence.
EpisodeRow episode_of(double confidence, int looks, int right, int index = 0) {
  EpisodeRow row = failed_episode("ours", index);
  for (int i = 0; i < looks; ++i) {
    row.confidence.add(confidence, i < right);
  }
  return row;
}

TEST(Reliability, CountsLooksOfAllEpisodesByTheirConfidence) {
  const Reliability reliability =
      reliability_of({episode_of(0.75, 10, 5, 0), episode_of(0.75, 30, 25, 1),
                      episode_of(0.25, 10, 4, 2), failed_episode("ours", 3)});
  EXPECT_EQ(reliability.looks, 50);
  EXPECT_EQ(reliability.bins[7].looks, 40);
  EXPECT_DOUBLE_EQ(reliability.bins[7].right.value, 0.75);
  EXPECT_NEAR(reliability.bins[7].stated, 0.75, 1e-12);
  EXPECT_DOUBLE_EQ(reliability.bins[2].right.value, 0.4);
  EXPECT_EQ(reliability.bins[0].looks, 0);
  EXPECT_TRUE(std::isnan(reliability.bins[0].right.value));
  // 40 looks that mean what they say, 10 that are off by 0.15.
  EXPECT_NEAR(reliability.calibration_error.value, 0.03, 1e-12);
}

TEST(Reliability, ItsIntervalsAreOverEpisodesNotLooks) {
  // Every episode all right or all wrong: hundreds of looks say no more than four episodes do.
  std::vector<EpisodeRow> rows;
  for (int i = 0; i < 4; ++i) {
    rows.push_back(episode_of(0.5, 500, i % 2 == 0 ? 500 : 0, i));
  }
  const Figure right = reliability_of(rows).bins[5].right;
  EXPECT_DOUBLE_EQ(right.value, 0.5);
  EXPECT_LE(right.low, 0.1);
  EXPECT_GE(right.high, 0.9);
  std::reverse(rows.begin(), rows.end());
  EXPECT_EQ(reliability_of(rows).bins[5].right.low, right.low);
}

TEST(Reliability, OfNoLooksIsNothing) {
  EXPECT_TRUE(std::isnan(reliability_of({failed_episode()}).calibration_error.value));
  const EpisodeTable table{"CL", 0.4, {failed_episode()}};
  EXPECT_EQ(reliability_table(table), "");
  EXPECT_EQ(reliability_plot({table}), "");
}

TEST(Reliability, HasATableAndADiagram) {
  const EpisodeTable table{"CL", 0.4, {episode_of(0.97, 20, 19)}};
  EXPECT_THAT(reliability_table(table), HasSubstr("| 0.95-0.99 | 20 | 97.0 | 95.0 (95.0-95.0) |"));
  EXPECT_THAT(reliability_table(table),
              HasSubstr("| calibration error [%] | 20 |  | 2.0 (2.0-2.0) |"));
  const std::string picture = reliability_plot({table});
  EXPECT_THAT(picture, HasSubstr("</svg>"));
  EXPECT_THAT(picture, ::testing::Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace cmn
