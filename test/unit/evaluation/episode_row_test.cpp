// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/episode_row.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "fake_episodes.hpp"
#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using ::testing::HasSubstr;

std::string csv_of(const std::vector<EpisodeRow>& rows) {
  std::string text = csv_header() + "\n";
  for (const EpisodeRow& row : rows) {
    text += csv_line(row) + "\n";
  }
  return text;
}

std::vector<EpisodeRow> read_back(const std::string& text) {
  std::istringstream in{text};
  return read_episodes(in, "episodes.csv");
}

TEST(EpisodeRow, SurvivesTheFile) {
  const std::vector<EpisodeRow> rows = fake_evaluation(3, 2);
  const std::string text = csv_of(rows);
  EXPECT_EQ(csv_of(read_back(text)), text);
  const EpisodeRow never = read_back(csv_of({failed_episode()})).front();
  EXPECT_TRUE(std::isnan(never.success_driven_m));
  EXPECT_EQ(never.converged_actions, -1);
}

TEST(EpisodeRow, OfAnInterruptedRunTheHalfLineIsLeftOut) {
  const std::string text = csv_of({failed_episode("ours", 0), failed_episode("ours", 1)});
  EXPECT_EQ(read_back(text.substr(0, text.size() - 1)).size(), 1U);
}

TEST(EpisodeRow, FaultsAreNamedByLine) {
  const std::string good = csv_of({failed_episode()});
  EXPECT_THAT(error_of([&] { read_back("x,y\n"); }), HasSubstr("episodes.csv:1:"));
  EXPECT_THAT(error_of([&] { read_back(good + "CL,intel,0.4\n"); }),
              HasSubstr("episodes.csv:3: too few columns"));
  EXPECT_THAT(error_of([&] { read_back(good + csv_line(failed_episode()) + ",1\n"); }),
              HasSubstr("episodes.csv:3: too many columns"));
  EXPECT_THAT(error_of([&] { read_back(csv_header() + "\nCL,intel,coarse,ours\n"); }),
              HasSubstr("episodes.csv:2: mpp is no number: \"coarse\""));
}

TEST(EpisodeRow, SplWeighsSuccessByTheShortestWay) {
  EXPECT_DOUBLE_EQ(successful_episode(4.0, 5.0).spl(), 0.8);
  // The goal counts from 0.4 m away, so the way may be shorter than the shortest one to its middle.
  EXPECT_DOUBLE_EQ(successful_episode(4.0, 3.7).spl(), 1.0);
  EXPECT_DOUBLE_EQ(failed_episode().spl(), 0.0);
}

TEST(EpisodeRow, OfAKidnappedRobotSplCountsFromTheDrop) {
  EpisodeRow row = successful_episode(4.0, 15.0);
  row.drop_actions = 60;
  row.drop_driven_m = 7.0;
  row.drop_shortest_m = 6.0;
  EXPECT_DOUBLE_EQ(row.spl(), 0.75);
  row.recovered_actions = 12;
  row.T_world_drop = {1.5, -2.0, 0.5};
  row.confidence.add(0.25, false);
  row.confidence.add(0.97, true);
  const EpisodeRow read = read_back(csv_of({row})).front();
  EXPECT_EQ(csv_line(read), csv_line(row));
  EXPECT_EQ(read.confidence.looks(), 2);
  EXPECT_EQ(read.T_world_drop.y, -2.0);
}

TEST(EpisodeKey, IsWhatItsNameSays) {
  for (const char* world : {"intel", "freiburg-079", "house:17", "a-1-b"}) {
    const EpisodeKey key{"CL", world, 0.45, "true_pose", 170, 0};
    EXPECT_EQ(parse_episode_id(key.id()), key) << key.id();
  }
  for (const char* id : {"", "CL-0.40-intel-17", "CL-0.40-intel-x-ours", "CL-intel-17-ours"}) {
    EXPECT_THROW(parse_episode_id(id), std::invalid_argument) << id;
  }
}

TEST(MergeEpisodes, GivesTheRunThatWasNotSplit) {
  const std::vector<EpisodeRow> whole = merge_episodes({fake_evaluation(3, 3)});
  std::vector<std::vector<EpisodeRow>> shards(4);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    shards[(i * 7) % 4].push_back(whole[i]);
  }
  EXPECT_EQ(csv_of(merge_episodes(shards)), csv_of(whole));
  EXPECT_TRUE(merge_episodes({}).empty());
}

TEST(MergeEpisodes, KeepsOneOfTwoThatAreTheSame) {
  EpisodeRow again = failed_episode();
  again.step_ms = 77.0;  // another machine
  const auto rows = merge_episodes({{failed_episode()}, {again, failed_episode("cmn")}});
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].key.method, "cmn");
  EXPECT_EQ(rows[1].step_ms, failed_episode().step_ms);
}

TEST(MergeEpisodes, RefusesEpisodesThatDiffer) {
  EpisodeRow other = failed_episode();
  other.collisions = 3;
  other.key.seed = 8;
  const std::string error = error_of([&] { merge_episodes({{failed_episode()}, {other}}); });
  EXPECT_THAT(error, HasSubstr("1 episode came out differently"));
  EXPECT_THAT(error, HasSubstr("CL-0.40-intel-0-ours: seed 7 or 8, collisions 0 or 3"));
}

}  // namespace
}  // namespace cmn
