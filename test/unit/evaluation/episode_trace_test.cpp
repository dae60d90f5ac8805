// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/episode_trace.hpp"

#include "coarse_map_nav/evaluation/map_view.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include "ascii_map.hpp"
#include "fake_episodes.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

bool has_colour(const cv::Mat& picture, const cv::Vec3b& colour) {
  cv::Mat same;
  cv::inRange(picture, colour, colour, same);
  return cv::countNonZero(same) > 0;
}

/// Ten steps east, the estimate 3 m north of the robot at first and then where it is.
EpisodeTrace trace_of(const std::string& method) {
  EpisodeTrace trace;
  trace.row = successful_episode(4.0, 5.0, method);
  trace.row.T_world_start = {1.5, 1.5, 0.0};
  trace.row.goal_world = {9.5, 1.5};
  trace.world = ascii_map(std::vector<std::string>(8, "............"));
  for (int i = 0; i < 10; ++i) {
    TraceStep step;
    step.T_world_robot = {1.5 + 0.8 * i, 1.5, 0.0};
    step.T_world_estimate = {1.5 + 0.8 * i, i < 5 ? 4.5 : 1.5, 0.0};
    step.confidence = i < 2 ? 0.1 : 0.9;
    step.entropy = 5.0 - 0.5 * i;
    trace.steps.push_back(step);
  }
  return trace;
}

TEST(TraceStep, IsRightWithinAMetreAndItsHeading) {
  TraceStep step;
  step.T_world_estimate = {0.6, 0.7, 0.7};
  EXPECT_TRUE(step.is_right());
  step.T_world_estimate.yaw = -0.8;
  EXPECT_FALSE(step.is_right());
  step.T_world_estimate = {0.8, 0.7, 0.0};
  EXPECT_FALSE(step.is_right());
}

TEST(TracePicture, ShadesWhatConvergedRightAndWrong) {
  const cv::Vec3b right{247, 234, 218};
  const cv::Vec3b wrong{205, 224, 250};
  EpisodeTrace trace = trace_of("ours");
  const cv::Mat both = trace_picture(trace);
  EXPECT_EQ(both.type(), CV_8UC3);
  EXPECT_TRUE(has_colour(both.colRange(both.cols / 2, both.cols), right));
  EXPECT_TRUE(has_colour(both.colRange(both.cols / 2, both.cols), wrong));
}

TEST(TracePicture, OfASingleStepCanBeDrawn) {
  EpisodeTrace trace = trace_of("ours");
  trace.steps.resize(1);
  EXPECT_FALSE(trace_picture(trace).empty());
  trace.steps.clear();
  EXPECT_THROW(trace_picture(trace), std::invalid_argument);
}

TEST(TraceComparison, IsOfOneEpisodeOnly) {
  EXPECT_FALSE(trace_comparison({trace_of("ours"), trace_of("cmn")}).empty());
  EpisodeTrace other = trace_of("cmn");
  other.row.key.index = 3;
  EXPECT_THROW(trace_comparison({trace_of("ours"), other}), std::invalid_argument);
  EXPECT_THROW(trace_comparison({}), std::invalid_argument);
}

TEST(MapView, CutOutKeepsTheFrame) {
  const CoarseMap map = ascii_map({"......", "....#.", "......", "......"}, 0.5, {10.0, 20.0, 0.5});
  const Point2 occupied = map.center_of({4, 2});
  const CoarseMap part = cut_out(map, {occupied}, 0.5);
  EXPECT_EQ(part.width(), 3);
  EXPECT_EQ(part.height(), 3);
  EXPECT_TRUE(part.is_occupied(part.cell_of(occupied)));
  EXPECT_EQ(part.free_count(), 8U);
  EXPECT_NEAR(norm(part.center_of({1, 1}) - occupied), 0.0, 1e-12);
  EXPECT_EQ(cut_out(map, {occupied}, 100.0).width(), 6);
  EXPECT_EQ(cut_out(map, {{500.0, 500.0}}, 1.0).width(), 6);
}

TEST(MapView, WhatLiesFarFromFreeGroundIsPaper) {
  const CoarseMap map = ascii_map({".#####"});
  const cv::Mat image = walls_of(map, 2.0);
  const auto is_dark = [&](int x) { return image.at<cv::Vec3b>(0, x)[0] < 128; };
  EXPECT_FALSE(is_dark(0));
  EXPECT_TRUE(is_dark(1) && is_dark(2));
  EXPECT_FALSE(is_dark(3) || is_dark(5));
}

}  // namespace
}  // namespace cmn
