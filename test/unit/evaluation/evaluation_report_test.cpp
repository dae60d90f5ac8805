// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/evaluation_report.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
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
namespace fs = std::filesystem;

/// Two methods on two episodes: SR 1 and 0.5, SPL (0.8 + 1) / 2 and 0.5 / 2.
std::vector<EpisodeRow> two_methods() {
  return {successful_episode(4.0, 8.0, "cmn", 1), successful_episode(4.0, 5.0, "ours", 0),
          failed_episode("cmn", 0), successful_episode(4.0, 3.9, "ours", 1)};
}

ReportContext context() {
  ReportContext context;
  context.command = "cmn_evaluate --task CL";
  context.machine = "two cores";
  context.seed = 42;
  context.settings = {{"odometry noise", "on | off"}};
  return context;
}

std::string report_of(const std::vector<EpisodeRow>& rows) {
  return report_files(rows, context()).at("report.md");
}

TEST(ResultLines, AreOneAMethodInTheirOrder) {
  EXPECT_THAT(result_lines(two_methods()),
              ElementsAre("RESULT task=CL mpp=0.40 method=ours SR=1.000 SPL=0.900 episodes=2",
                          "RESULT task=CL mpp=0.40 method=cmn SR=0.500 SPL=0.250 episodes=2"));
  EXPECT_TRUE(result_lines({}).empty());
}

TEST(ResultLines, SayWhatPanoramasCost) {
  std::vector<EpisodeRow> rows = two_methods();
  rows[1].pivots = 30;
  rows[1].simulated_s = 200.0;
  rows[3].pivots = 50;
  rows[3].simulated_s = 300.0;
  EXPECT_THAT(result_lines(rows).front(), HasSubstr("episodes=2 pivots=40 seconds=250"));
  EXPECT_THAT(report_of(rows), HasSubstr("| 0.0 | 0.0 | 30 | 40 | 250 |"));
}

TEST(EvaluationReport, SaysHowWellTheRobotSawWhereAnybodyKnows) {
  std::vector<EpisodeRow> rows = two_methods();
  EXPECT_THAT(report_of(rows), Not(HasSubstr("| IoU of free ground")));
  rows[1].free_iou = 0.9;
  rows[1].obstacle_iou = 0.5;
  EXPECT_THAT(report_of(rows), HasSubstr("| ours | 90.0 | 50.0 |"));
  EXPECT_THAT(report_of(rows), HasSubstr("| CMN | - | - |"));
}

TEST(EvaluationReport, HasTheFiguresAndHowTheyWereMade) {
  const std::string report = report_of(two_methods());
  for (const char* part :
       {"| command | `cmn_evaluate --task CL` |", "| machine | two cores |", "| seed | 42 |",
        "| odometry noise | on \\| off |", "## CL: coarse-grid map, LiDAR 360 deg, unknown yaw",
        "### CL, 0.40 m/cell", "| ours | 2 | 100.0 (34.2-100.0) | 90.0 (80.0-100.0) | 0.0 | 0.0 |",
        "| CMN | 2 | 50.0 (9.5-90.5) | 25.0 (0.0-50.0) |", "All in one building: intel.",
        "| CMN | 2 | 1 | 0 | 1.0000 |", "](success_CL.svg)"}) {
    EXPECT_THAT(report, HasSubstr(part));
  }
  EXPECT_THAT(report, Not(HasSubstr("nan")));
  EXPECT_THAT(report, Not(HasSubstr("Beside the paper")));
}

TEST(EvaluationReport, SaysHowManyKidnappedRobotsFoundOut) {
  std::vector<EpisodeRow> rows = two_methods();
  EXPECT_THAT(report_of(rows), Not(HasSubstr("| kidnapped |")));
  for (EpisodeRow& row : rows) {
    row.drop_actions = 4;
    row.drop_driven_m = 0.0;
    row.drop_shortest_m = row.shortest_m;
    row.recovered_actions = row.is_success ? 12 : -1;
  }
  const std::string report = report_of(rows);
  EXPECT_THAT(report, HasSubstr("| ours | 2 | 100.0 (34.2-100.0) | 12 | 100.0 | 0.0 |"));
  EXPECT_THAT(report, HasSubstr("| CMN | 2 | 50.0 (9.5-90.5) | - | 50.0 | 0.0 |"));
  EXPECT_THAT(result_lines(rows).front(),
              HasSubstr(" episodes=2 recovered=1.000 median_actions=12"));
}

TEST(EvaluationReport, IsTheSameInWhateverOrderEpisodesEnded) {
  std::vector<EpisodeRow> rows = fake_evaluation(2, 3, {"CL", "CG"});
  const std::map<std::string, std::string> files = report_files(rows, context());
  std::reverse(rows.begin(), rows.end());
  // step_ms is a mean of floats, the last bit of which is not printed.
  EXPECT_EQ(report_files(rows, context()), files);
}

TEST(EvaluationReport, SetsThePapersFiguresBesideOurs) {
  const std::string report = report_of(fake_evaluation(2, 3, {"CG"}, {0.3, 0.5}));
  EXPECT_THAT(report, HasSubstr("| CMN | 94.7 / 58.0 | "));
  EXPECT_THAT(report, HasSubstr(" | 95.7 / 57.3 | - | 83.8 / 51.9 | "));
}

TEST(EvaluationReport, WarnsWhenMethodsRanDifferentEpisodes) {
  std::vector<EpisodeRow> rows = two_methods();
  EXPECT_THAT(report_of(rows), Not(HasSubstr("Not on the same episodes")));
  rows.erase(rows.begin());
  EXPECT_THAT(report_of(rows), HasSubstr("**Not on the same episodes:** CMN (1 of 2)."));
}

TEST(EvaluationReport, TellsThatARunWasInterrupted) {
  ReportContext interrupted = context();
  EXPECT_THAT(report_files(two_methods(), interrupted).at("report.md"), Not(HasSubstr("Interr")));
  interrupted.is_interrupted = true;
  EXPECT_THAT(report_files(two_methods(), interrupted).at("report.md"), HasSubstr("Interrupted"));
}

TEST(EvaluationReport, OfNoEpisodesIsStillAReport) {
  const auto files = report_files({}, context());
  EXPECT_EQ(files.size(), 1U);
  EXPECT_THAT(files.at("report.md"), HasSubstr("| episodes | 0, in 0 worlds |"));
}

TEST(EvaluationReport, NamesEpisodesWithoutARouteAndCountsThemNowhere) {
  std::vector<EpisodeRow> rows = two_methods();
  EXPECT_THAT(report_of(rows), Not(HasSubstr("Left out")));
  for (const char* method : {"ours", "cmn"}) {
    for (const int index : {3, 13}) {
      rows.push_back(failed_episode(method, index));
      rows.back().key.world = "house:9";
      rows.back().end = "no route";
    }
  }
  const std::string report = report_of(rows);
  EXPECT_THAT(report, HasSubstr("**Left out of everything below:**"));
  EXPECT_THAT(report, HasSubstr("- house:9, CL, 0.40 m/cell: 3, 13\n"));
  EXPECT_THAT(report, HasSubstr("| episodes | 4, in 1 worlds |"));
  EXPECT_EQ(result_lines(rows), result_lines(two_methods()));
}

TEST(EvaluationReport, EveryPictureOfItIsAmongItsFiles) {
  const auto files = report_files(fake_evaluation(2, 2, {"CL", "HL"}), context());
  EXPECT_EQ(files.size(), 1U + 2U * 4U);
  for (const auto& [name, content] : files) {
    if (name != "report.md") {
      EXPECT_THAT(files.at("report.md"), HasSubstr("](" + name + ")"));
      EXPECT_THAT(content, HasSubstr("</svg>"));
      EXPECT_THAT(content, Not(HasSubstr("nan")));
    }
  }
  // Nobody converged: no such picture.
  EXPECT_EQ(report_files(two_methods(), context()).count("convergence_CL.svg"), 0U);
}

TEST(EvaluationReport, GoesToAFolderOfItsOwn) {
  const fs::path folder = fs::path{file_with("x", "")}.parent_path() / "evaluation" / "deeper";
  fs::remove_all(folder);
  write_report(two_methods(), context(), folder.string());
  for (const auto& [name, content] : report_files(two_methods(), context())) {
    std::ostringstream written;
    written << std::ifstream{folder / name, std::ios::binary}.rdbuf();
    EXPECT_EQ(written.str(), content) << name;
  }
  const std::string blocked = file_with("blocked", "a file where the folder should be");
  EXPECT_THAT(error_of([&] { write_report(two_methods(), context(), blocked); }),
              HasSubstr(blocked));
}

}  // namespace
}  // namespace cmn
