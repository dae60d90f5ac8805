// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/run_report.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include "ascii_map.hpp"
#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace cmn {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

RunOutcome arrived() {
  RunOutcome outcome;
  outcome.world = "worlds/home.yaml";
  outcome.seed = 7;
  outcome.goal = {"sofa", {1.0, 2.0}, Point2{3.0, 4.0}};
  outcome.state = "REACHED";
  outcome.reason = "it says \"here\"";
  outcome.actions = 12;
  outcome.T_world_end = Pose2{3.0, 4.5, 0.0};
  return outcome;
}

TEST(RunReport, SummaryTellsWhatHappened) {
  RunRecord record;
  record.add(TrackPoint{0.0, Pose2{1.0, 1.0, kPi / 2.0}});
  record.add(TrackPoint{4.0, Pose2{1.0, 3.0, kPi / 2.0}});
  const std::string json = summary_json(record, arrived());
  for (const char* part : {R"("reached": true)", R"("state": "REACHED")",
                           R"("reason": "it says \"here\"")", R"("true_distance_to_goal_m": 0.5)",
                           R"("actions": 12)", R"("seed": 7)", R"("driven_m": 2.0)",
                           R"("sim_time_s": 4.0)", R"("yaw_deg": 90.0)", R"("localized": false)"}) {
    EXPECT_THAT(json, HasSubstr(part));
  }
}

TEST(RunReport, WhatIsNotKnownIsNull) {
  RunOutcome outcome = arrived();
  outcome.state = "FAILED";
  outcome.goal.world.reset();
  const std::string json = summary_json({}, outcome);
  EXPECT_THAT(json, HasSubstr(R"("reached": false)"));
  EXPECT_THAT(json, HasSubstr(R"("true_distance_to_goal_m": null)"));
  EXPECT_THAT(json, HasSubstr(R"("start": null)"));
}

TEST(RunReport, LeavesPicturesAndSummaryInAFolderOfItsOwn) {
  const fs::path out = fs::path{file_with("x", "")}.parent_path() / "run_report" / "deeper";
  fs::remove_all(out);
  RunSetting setting;
  setting.map = ascii_map({"....", "...."});
  RunRecord record;
  RunMoment moment;
  moment.marginal = Grid<float>(4, 2, 0.125F);
  record.add(moment);
  write_run_report(out.string(), setting, record, arrived());
  EXPECT_EQ(cv::imread((out / "run.png").string()).cols, 1400);
  EXPECT_GT(fs::file_size(out / "run.gif"), 100U);
  EXPECT_TRUE(fs::exists(out / "summary.json"));
  EXPECT_FALSE(fs::exists(out / "summary.json.part"));
}

TEST(RunReport, ARunThatNeverBeganHasASummaryOnly) {
  const fs::path out = fs::path{file_with("x", "")}.parent_path() / "run_report_empty";
  fs::remove_all(out);
  write_run_report(out.string(), {}, {}, arrived());
  EXPECT_TRUE(fs::exists(out / "summary.json"));
  EXPECT_FALSE(fs::exists(out / "run.png"));
}

}  // namespace
}  // namespace cmn
