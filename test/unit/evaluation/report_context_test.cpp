// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/report_context.hpp"

#include <string>
#include <utility>
#include <vector>

#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

ReportContext shard(int i) {
  ReportContext context;
  context.command = "cmn_evaluate --shard " + std::to_string(i) + "/2 --out 'a: b'";
  context.machine = "machine " + std::to_string(i);
  context.version = "0.1.0";
  context.seed = 18446744073709551615U;
  context.horizon = 300;
  context.wall_time_s = 12.5;
  context.settings = {{"sliding", "on: yes"}};
  return context;
}

TEST(ReportContext, SurvivesTheFile) {
  const std::string path = file_with("run.yaml", "");
  write_context(shard(1), path);
  const ReportContext read = read_context(path);
  EXPECT_EQ(read.command, shard(1).command);
  EXPECT_EQ(read.machine, shard(1).machine);
  EXPECT_EQ(read.version, shard(1).version);
  EXPECT_EQ(read.seed, shard(1).seed);
  EXPECT_EQ(read.robot_radius_m, 0.18);
  EXPECT_EQ(read.horizon, 300);
  EXPECT_EQ(read.wall_time_s, 12.5);
  EXPECT_FALSE(read.is_interrupted);
  EXPECT_EQ(read.settings, shard(1).settings);
}

TEST(ReportContext, FilesThatCannotBeReadAreNamed) {
  EXPECT_THAT(error_of([] { read_context("/nowhere/run.yaml"); }), HasSubstr("/nowhere/run.yaml"));
  const std::string path = file_with("run.yaml", "seed: many");
  EXPECT_THAT(error_of([&] { read_context(path); }), HasSubstr(path));
}

TEST(ReportContext, OfSeveralRunsNamesEach) {
  ReportContext second = shard(2);
  second.is_interrupted = true;
  const ReportContext merged = merge_contexts({shard(1), second});
  EXPECT_EQ(merged.horizon, 300);
  EXPECT_TRUE(merged.is_interrupted);
  EXPECT_THAT(
      merged.settings,
      ElementsAre(std::pair<std::string, std::string>{"sliding", "on: yes"},
                  std::pair<std::string, std::string>{
                      "part 1", "`cmn_evaluate --shard 1/2 --out 'a: b'` on machine 1, 12 s"},
                  std::pair<std::string, std::string>{
                      "part 2", "`cmn_evaluate --shard 2/2 --out 'a: b'` on machine 2, 12 s"}));
}

TEST(ReportContext, OfRunsWithOtherMethodsHasTheSettingsOfAll) {
  ReportContext second = shard(2);
  second.settings.emplace_back("ours+no_x", "a: 1");
  EXPECT_EQ(merge_contexts({shard(1), second}).settings.at(1).first, "ours+no_x");
  ReportContext third = shard(3);
  third.settings.emplace_back("ours+no_x", "a: 2");
  EXPECT_THAT(error_of([&] {
                merge_contexts({shard(1), second, third});
              }),
              HasSubstr("--shard 3/2"));
}

TEST(ReportContext, OfRunsThatDifferIsNotMerged) {
  ReportContext other = shard(2);
  other.seed = 2;
  EXPECT_THAT(error_of([&] { merge_contexts({shard(1), other}); }), HasSubstr("--shard 2/2"));
}

}  // namespace
}  // namespace cmn
