// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/episode_group.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "fake_episodes.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using ::testing::ElementsAre;

TEST(EpisodeGroup, TablesAndMethodsHaveTheirOrderWhateverThatOfTheRows) {
  std::vector<EpisodeRow> rows = fake_evaluation(1, 1, {"ZZ", "HL", "CL", "CG", "AA"}, {0.5, 0.3});
  rows.push_back(failed_episode("a_new_one"));
  std::reverse(rows.begin(), rows.end());
  std::vector<std::string> names;
  for (const EpisodeTable& table : episode_tables(rows)) {
    names.push_back(table.task + std::to_string(table.mpp).substr(0, 3));
  }
  EXPECT_THAT(names, ElementsAre("CG0.3", "CG0.5", "CL0.3", "CL0.4", "CL0.5", "HL0.3", "HL0.5",
                                 "AA0.3", "AA0.5", "ZZ0.3", "ZZ0.5"));
  EXPECT_THAT(methods_of(rows), ElementsAre("ours", "cmn", "robb", "mcse", "rmn", "rnd",
                                            "true_pose", "oracle", "a_new_one"));
}

TEST(EpisodeGroup, HousesAreOneBuilding) {
  const std::vector<EpisodeRow> rows = fake_evaluation(1, 2, {"CL"}, {0.4});
  EXPECT_THAT(buildings_of(rows), ElementsAre("houses", "fhw", "intel"));
  EXPECT_EQ(of_building(rows, "houses").size(), 2U * 2U * 8U);
  EXPECT_EQ(of_building(rows, "intel").size(), 2U * 8U);
  EXPECT_EQ(of_method(rows, "cmn").size(), 4U * 2U);
}

TEST(EpisodeGroup, UnknownNamesAreShownAsTheyAre) {
  EXPECT_EQ(method_label("true_pose"), "true pose");
  EXPECT_EQ(method_label("amcl"), "amcl");
  EXPECT_EQ(task_title("XX"), "XX");
  EXPECT_EQ(task_title("WL"), "WL: walls-only map, LiDAR 360 deg, unknown yaw");
}

}  // namespace
}  // namespace cmn
