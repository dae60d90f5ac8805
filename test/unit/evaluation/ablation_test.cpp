// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/ablation.hpp"

#include "coarse_map_nav/evaluation/evaluation_report.hpp"
#include "coarse_map_nav/evaluation/method.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "fake_episodes.hpp"
#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kConfig = CMN_SOURCE_DIR "/config";
const std::string kShipped = kConfig + "/variants/ablation.yaml";

std::vector<std::string> names_of(const std::vector<Method>& methods) {
  std::vector<std::string> names;
  for (const Method& method : methods) {
    names.push_back(method.name);
  }
  return names;
}

TEST(Variants, AreReadByTheirNames) {
  const Variants variants =
      read_variants(file_with("v.yaml", "a: {planning: {policy: path}}\nb: {motion: {x: 1}}\n"));
  ASSERT_EQ(variants.size(), 2U);
  EXPECT_EQ(std::get<std::string>(variants.at("a").at("planning/policy")), "path");
  const std::string error = error_of([] {
    read_variants(file_with("w.yaml", "seed: 3\nall: {motion: {x: 1}}\nA-b: {motion: {x: 1}}\n"));
  });
  for (const char* part : {"w.yaml", "seed is no group", "all is no name", "A-b is no name"}) {
    EXPECT_THAT(error, HasSubstr(part));
  }
}

TEST(Variants, ThoseThatAreShippedAllChangeSomethingInRolling) {
  const Variants variants = read_variants(kShipped);
  EXPECT_EQ(methods_named({"rolling+all"}, variants, kConfig).size(), variants.size());
  // ours has no rolling map.
  EXPECT_EQ(methods_named({"ours+all"}, variants, kConfig).size(), variants.size() - 1);
}

TEST(Variants, ChangeThePresetOfTheirMethodAndNothingElse) {
  const Variants variants = read_variants(kShipped);
  const std::vector<Method> methods =
      methods_named({"rolling", "rolling+no_map_repair"}, variants, kConfig);
  EXPECT_THAT(names_of(methods), ElementsAre("rolling", "rolling+no_map_repair"));
  const NavigatorParams whole = method_params(methods[0], find_task("CL"), kConfig);
  const NavigatorParams less = method_params(methods[1], find_task("CL"), kConfig);
  EXPECT_TRUE(whole.planning.map_repair.enabled);
  EXPECT_FALSE(less.planning.map_repair.enabled);
  EXPECT_EQ(less.localization.filter, whole.localization.filter);
  EXPECT_EQ(less.perception.accumulate, "rolling");
}

TEST(Variants, AllThatIsWrongIsSaidAtOnce) {
  const Variants variants{{"bad", {{"planning/polcy", std::string{"path"}}}},
                          {"same", {{"localization/filter", std::string{"scaled"}}}}};
  const std::string error = error_of([&] {
    methods_named({"magic", "ours+none", "ours+same", "ours+bad", "cmn", "cmn"}, variants, kConfig);
  });
  for (const char* part :
       {"method \"magic\" is none of ours", "variant \"none\" of ours is none of all, bad, same",
        "ours+same changes nothing", "ours+bad:", "did you mean planning/policy",
        "method cmn is named twice"}) {
    EXPECT_THAT(error, HasSubstr(part));
  }
}

/// The whole succeeds in 3 of 4, without one part in 1 of them.
std::vector<EpisodeRow> ablated() {
  std::vector<EpisodeRow> rows;
  for (int i = 0; i < 4; ++i) {
    rows.push_back(i < 3 ? successful_episode(4.0, 5.0, "rolling", i)
                         : failed_episode("rolling", i));
    rows.push_back(i < 1 ? successful_episode(4.0, 8.0, "rolling+no_x", i)
                         : failed_episode("rolling+no_x", i));
  }
  return rows;
}

TEST(AblationTable, SetsEachVariantAgainstTheWhole) {
  const std::string text = ablation_table({"CL", 0.4, ablated()});
  EXPECT_THAT(text, HasSubstr("| **rolling** | 4 | 75.0 | 60.0 |"));
  EXPECT_THAT(text, HasSubstr("| rolling+no_x | 4 | 25.0 | 12.5 |"));
  EXPECT_THAT(text, HasSubstr("| -50.0 ("));
  EXPECT_THAT(text, HasSubstr("| -47.5 ("));
  std::vector<EpisodeRow> rows = ablated();
  EXPECT_EQ(ablation_table({"CL", 0.4, of_method(rows, "rolling")}), "");
  EXPECT_EQ(ablation_table({"CL", 0.4, of_method(rows, "rolling+no_x")}), "");
}

TEST(AblationTable, VariantsAreInItAndInNoOtherTableOrPlot) {
  const auto files = report_files(ablated(), {});
  EXPECT_EQ(files.count("ablation_CL.svg"), 1U);
  EXPECT_THAT(files.at("ablation_CL.svg"), HasSubstr("rolling+no_x"));
  EXPECT_THAT(files.at("bars_CL.svg"), Not(HasSubstr("no_x")));
  EXPECT_THAT(result_lines(ablated()),
              ElementsAre("RESULT task=CL mpp=0.40 method=rolling SR=0.750 SPL=0.600 episodes=4",
                          "RESULT task=CL mpp=0.40 method=rolling+no_x SR=0.250 SPL=0.125 "
                          "episodes=4"));
}

}  // namespace
}  // namespace cmn
