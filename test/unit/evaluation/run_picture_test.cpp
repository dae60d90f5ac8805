// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/run_picture.hpp"

#include <cmath>
#include <stdexcept>

#include "ascii_map.hpp"
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

double luminance(const cv::Scalar& bgr) { return 0.114 * bgr[0] + 0.587 * bgr[1] + 0.299 * bgr[2]; }

/// A drawing 6 m wide of a world twice as large, and a journey of `count` moments to the east.
RunSetting setting_of_a_room() {
  RunSetting setting;
  setting.map = ascii_map({"######", "#....#", "#....#", "######"});
  setting.goal_map = {4.5, 2.5};
  setting.world = ascii_map({"######", "#....#", "#....#", "######"}, 2.0);
  setting.goal_world = Point2{9.0, 5.0};
  setting.warp.emplace(std::vector<Place>{{"a", {2.0, 2.0}, {1.0, 1.0}},
                                          {"b", {10.0, 2.0}, {5.0, 1.0}},
                                          {"c", {2.0, 6.0}, {1.0, 3.0}}});
  return setting;
}

RunRecord journey(const CoarseMap& map, int count) {
  RunRecord record;
  for (int i = 0; i < count; ++i) {
    RunMoment moment;
    moment.time_s = i;
    moment.marginal = Grid<float>(map.width(), map.height(), 0.0F);
    moment.marginal({1 + i % 4, 1}) = 1.0F;
    moment.T_map_estimate = {1.5 + i % 4, 1.5, 0.0};
    moment.converged = i > 0;
    moment.T_world_robot = Pose2{3.0 + 2.0 * (i % 4), 3.0, 0.0};
    record.add(TrackPoint{moment.time_s, *moment.T_world_robot});
    record.add(std::move(moment));
  }
  return record;
}

/// Whether a picture has a pixel of nearly this colour.
bool shows(const cv::Mat& picture, const cv::Scalar& bgr) {
  cv::Mat near;
  cv::inRange(picture, bgr - cv::Scalar::all(6), bgr + cv::Scalar::all(6), near);
  return cv::countNonZero(near) > 4;
}
const cv::Scalar kGoal{150, 20, 190};
const cv::Scalar kTruth{80, 150, 20};
const cv::Scalar kEstimate{200, 90, 20};

TEST(RunPicture, HeatGetsDarkerWithTheProbability) {
  const double p_faint = 1e-4;
  EXPECT_EQ(luminance(heat_colour(0.0, p_faint)), 255.0);
  EXPECT_EQ(luminance(heat_colour(std::nan(""), p_faint)), 255.0);
  double last = 256.0;
  for (double p = p_faint; p <= 1.0; p *= 1.1) {
    const double now = luminance(heat_colour(p, p_faint));
    EXPECT_LT(now, last) << "at " << p;
    last = now;
  }
  EXPECT_LT(luminance(heat_colour(1.0, p_faint)), 60.0);
}

TEST(RunPicture, BeliefCellsLieAsThePictureIsSeen) {
  const CoarseMap map = ascii_map({"....", "#..."});
  Grid<float> marginal(4, 2, 0.0F);
  marginal({3, 1}) = 1.0F;  // the upper right cell
  marginal({0, 0}) = 0.5F;  // a wall: its probability is not shown
  const cv::Mat cells = belief_cells(map, marginal);
  ASSERT_EQ(cells.size(), cv::Size(4, 2));
  const auto at = [&](int column, int row) {
    return luminance(cv::Scalar(cells.at<cv::Vec3b>(row, column)));
  };
  EXPECT_LT(at(3, 0), 60.0);
  EXPECT_EQ(at(0, 0), 255.0);
  EXPECT_EQ(at(1, 1), 255.0);
  EXPECT_LT(at(0, 1), 120.0);
  EXPECT_GT(at(0, 1), 60.0);
}

TEST(RunPicture, IsAPageWideAndShowsGoalTruthAndEstimate) {
  const RunSetting setting = setting_of_a_room();
  const cv::Mat picture = run_picture(setting, journey(setting.map, 30), "title", "subtitle");
  EXPECT_EQ(picture.cols, 1400);
  EXPECT_EQ(picture.type(), CV_8UC3);
  EXPECT_GT(picture.rows, 400);
  EXPECT_LT(picture.rows, 1400);
  for (const cv::Scalar& colour : {kGoal, kTruth, kEstimate}) {
    EXPECT_TRUE(shows(picture, colour));
  }
}

TEST(RunPicture, ShrinksWordsThatWouldRunOffThePage) {
  const RunSetting setting = setting_of_a_room();
  const std::string long_words(300, 'M');
  const auto margin_of = [](const cv::Mat& picture) {
    cv::Mat dark;
    cv::inRange(picture(cv::Rect{0, 0, picture.cols, 55}), cv::Scalar::all(0), cv::Scalar::all(120),
                dark);
    return picture.cols - (cv::boundingRect(dark).x + cv::boundingRect(dark).width);
  };
  EXPECT_GT(margin_of(run_picture(setting, journey(setting.map, 30), long_words, long_words)), 15);
  EXPECT_GT(
      margin_of(run_film(setting, journey(setting.map, 30), long_words, long_words, 1)[0].picture),
      10);
}

TEST(RunPicture, LeavesTheTruthOutWhereItIsNotKnown) {
  RunSetting setting = setting_of_a_room();
  setting.world.reset();
  setting.goal_world.reset();
  setting.warp.reset();
  const cv::Mat picture = run_picture(setting, journey(setting.map, 30), "title", "subtitle");
  EXPECT_FALSE(shows(picture, kTruth));
  EXPECT_TRUE(shows(picture, kEstimate));
}

TEST(RunPicture, MarksTheGoalWhereItIsOnATurnedDrawing) {
  // The drawing's frame is turned by a quarter: the goal, in metres, still falls into its cell.
  RunSetting setting;
  setting.map = ascii_map({"....", "...."}, 1.0, Pose2{10.0, 5.0, kPi / 2.0});
  setting.goal_map = setting.map.center_of({3, 0});
  RunRecord record = journey(setting.map, 0);
  RunMoment moment;
  moment.marginal = Grid<float>(4, 2, 0.0F);
  const Point2 away = setting.map.center_of({0, 1});
  moment.T_map_estimate = {away.x, away.y, 0.0};
  record.add(moment);
  const cv::Mat frame = run_film(setting, record, "title", "end", 1).front().picture;
  cv::Mat goal;
  cv::inRange(frame, kGoal - cv::Scalar::all(6), kGoal + cv::Scalar::all(6), goal);
  const cv::Moments m = cv::moments(goal, true);
  EXPECT_NEAR(m.m10 / m.m00, 16.0 + 440.0 * 3.5 / 4.0, 2.0);
  EXPECT_NEAR(m.m01 / m.m00, 62.0 + 440.0 * 1.5 / 4.0, 2.0);
}

TEST(RunPicture, FilmEndsWithTheLastMomentWhateverTheCount) {
  const RunSetting setting = setting_of_a_room();
  for (const int count : {1, 2, 7, 30}) {
    SCOPED_TRACE(count);
    const RunRecord record = journey(setting.map, count);
    const std::vector<FilmFrame> film = run_film(setting, record, "title", "reached", 10);
    EXPECT_EQ(film.size(), static_cast<std::size_t>(std::min(count, 10)));
    EXPECT_EQ(film.back().duration_s, 3.0);
    for (const FilmFrame& frame : film) {
      EXPECT_EQ(frame.picture.size(), film.front().picture.size());
    }
  }
}

TEST(RunPicture, RefusesAJourneyWithoutBeliefOrWithAnotherDrawings) {
  const RunSetting setting = setting_of_a_room();
  EXPECT_THROW(run_picture(setting, {}, "", ""), std::invalid_argument);
  EXPECT_THROW(run_film(setting, {}, "", "", 10), std::invalid_argument);
  const RunRecord other = journey(ascii_map({".....", "....."}), 3);
  EXPECT_THROW(run_picture(setting, other, "", ""), std::invalid_argument);
}

}  // namespace
}  // namespace cmn
