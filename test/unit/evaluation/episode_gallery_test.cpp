// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/episode_gallery.hpp"

#include "coarse_map_nav/evaluation/episode_group.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include "ascii_map.hpp"
#include "fake_episodes.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A drive of 0.1 m an action along a corridor, unsure at first.
EpisodeTrace drive(int actions) {
  EpisodeTrace trace;
  trace.world = ascii_map(std::vector<std::string>(6, std::string(40, '.')));
  trace.row = failed_episode();
  trace.row.actions = actions;
  for (int i = 0; i <= actions; ++i) {
    TraceStep step;
    step.T_world_robot = {1.0 + 0.1 * i, 2.0, 0.0};
    step.T_world_estimate = step.T_world_robot;
    step.confidence = 0.2;
    trace.steps.push_back(step);
  }
  return trace;
}

/// Sure from an action on, of a place that is off by so much.
void be_sure(EpisodeTrace& trace, int from, double off_m) {
  trace.row.converged_actions = from;
  for (std::size_t i = static_cast<std::size_t>(from); i < trace.steps.size(); ++i) {
    trace.steps[i].confidence = 0.97;
    trace.steps[i].is_converged = true;
    trace.steps[i].T_world_estimate.y += off_m;
  }
}

TEST(EpisodeCause, IsThatOfTheFirstRuleThatHolds) {
  EpisodeTrace refused = drive(0);
  refused.steps.clear();
  refused.row.end = "goal refused";
  EXPECT_EQ(cause_of(refused).kind, "goal refused");

  EpisodeTrace never = drive(150);
  EXPECT_EQ(cause_of(never).kind, "never converged");
  EXPECT_THAT(cause_of(never).detail, HasSubstr("confidence 0.20 at most"));

  EpisodeTrace wrong = drive(150);
  be_sure(wrong, 40, 5.0);
  EXPECT_EQ(cause_of(wrong).kind, "converged falsely");
  EXPECT_THAT(cause_of(wrong).detail, HasSubstr("from action 40 to the end, off by 5.0 m"));

  EpisodeTrace lost = drive(150);
  be_sure(lost, 40, 0.0);
  for (std::size_t i = 90; i < lost.steps.size(); ++i) {
    lost.steps[i].is_converged = false;
  }
  EXPECT_EQ(cause_of(lost).kind, "lost its place");
  EXPECT_THAT(cause_of(lost).detail, HasSubstr("not sure from action 90"));

  EpisodeTrace late = drive(150);
  be_sure(late, 40, 0.0);
  EXPECT_EQ(cause_of(late).kind, "knew its place, ran out of actions");

  EpisodeTrace stuck = late;
  for (TraceStep& step : stuck.steps) {
    step.T_world_robot.x = step.T_world_estimate.x = 2.0;
  }
  EXPECT_EQ(cause_of(stuck).kind, "knew its place, did not get on");

  EpisodeTrace declared = wrong;
  declared.row.is_declared = true;
  EXPECT_EQ(cause_of(declared).kind, "declared elsewhere");

  EpisodeTrace carried = declared;
  carried.row.drop_actions = 50;
  EXPECT_EQ(cause_of(carried).kind, "did not recover");
  carried.row.recovered_actions = 9;
  EXPECT_EQ(cause_of(carried).kind, "declared elsewhere");
}

TEST(EpisodeCause, OfASuccessSaysWhatMadeTheWayLong) {
  EpisodeTrace trace = drive(100);
  trace.row = successful_episode(3.0, 10.0);
  trace.row.success_actions = 100;
  EpisodeTrace late = trace;
  be_sure(late, 80, 0.0);
  EXPECT_EQ(cause_of(late).kind, "knew its place late");
  EpisodeTrace early = trace;
  be_sure(early, 5, 0.0);
  EXPECT_EQ(cause_of(early).kind, "detour");
  EpisodeTrace misled = trace;
  be_sure(misled, 70, 3.0);
  EXPECT_EQ(cause_of(misled).kind, "misled on the way");
}

TEST(EpisodeCause, OfAKidnappedRobotCountsFromTheDrop) {
  EpisodeTrace trace = drive(100);
  trace.row = successful_episode(3.0, 10.0);
  trace.row.success_actions = 100;
  trace.row.drop_actions = 50;
  trace.row.drop_driven_m = 5.0;
  trace.row.drop_shortest_m = 2.0;
  be_sure(trace, 0, 0.0);
  for (std::size_t i = 51; i < trace.steps.size(); ++i) {
    trace.steps[i].T_world_robot.y += 3.0;
    trace.steps[i].T_world_estimate.y += i < 90 ? 0.0 : 3.0;
  }
  EXPECT_EQ(cause_of(trace).kind, "misled on the way");
  for (std::size_t i = 51; i < 90; ++i) {
    trace.steps[i].is_converged = false;
  }
  EXPECT_EQ(cause_of(trace).kind, "knew its place late");
  EXPECT_THAT(cause_of(trace).detail, HasSubstr("after action 39 and 3.9 m"));
}

TEST(WorstEpisodes, AreFailuresFirstTheFarthestAboveAllThenLowSpl) {
  std::vector<EpisodeRow> rows{successful_episode(4.0, 5.0, "ours", 0), failed_episode("ours", 1),
                               successful_episode(4.0, 9.0, "ours", 2), failed_episode("ours", 3),
                               failed_episode("ours", 4)};
  rows[3].closest_m = 12.0;
  rows[4].end = kNoRoute;
  std::vector<int> order;
  for (const EpisodeRow& row : worst_episodes(rows, 10)) {
    order.push_back(row.key.index);
  }
  EXPECT_THAT(order, ElementsAre(3, 1, 2, 0));
  EXPECT_EQ(worst_episodes(rows, 2).size(), 2U);
}

TEST(Gallery, HasARowAndAPictureOfEach) {
  EpisodeTrace wrong = drive(30);
  be_sure(wrong, 10, 2.0);
  wrong.row.key.world = "house:3";
  EpisodeTrace refused;
  refused.row = failed_episode("ours", 1);
  refused.row.end = "goal refused";
  const std::string text = gallery_table({wrong, refused});
  EXPECT_THAT(text, HasSubstr("| [CL-0.40-house:3-0-ours](CL-0.40-house_3-0-ours.png) | "
                              "converged falsely | sure of a wrong place"));
  EXPECT_THAT(text, HasSubstr("| CL-0.40-intel-1-ours | goal refused |"));
  const cv::Mat one = gallery_sheet({wrong, refused});
  const cv::Mat two = gallery_sheet({wrong, wrong, refused});
  EXPECT_GT(two.cols, one.cols);
  EXPECT_EQ(two.rows, one.rows);
  EXPECT_THROW(gallery_sheet({refused}), std::invalid_argument);
}

}  // namespace
}  // namespace cmn
