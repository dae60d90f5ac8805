// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/localization_error.hpp"

#include "coarse_map_nav/evaluation/error_plot.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace cmn {
namespace {

using testing::HasSubstr;

/// The robot drives east at 1 m/s from (0, 0) for 10 s.
TruthTrack eastward() {
  TruthTrack truth;
  truth.add(100.0, {0.0, 0.0, 0.0});
  truth.add(110.0, {10.0, 0.0, 0.0});
  return truth;
}

BeliefSample belief(double stamp, const Pose2& pose, bool converged) {
  return {stamp, pose, converged ? 0.9 : 0.1, 2.0, converged};
}

TEST(TruthTrack, InterpolatesAndKnowsItsEnds) {
  const TruthTrack truth = eastward();
  EXPECT_FALSE(truth.at(99.9));
  EXPECT_FALSE(truth.at(110.1));
  EXPECT_EQ(truth.at(100.0)->x, 0.0);
  EXPECT_NEAR(truth.at(102.5)->x, 2.5, 1e-12);
  EXPECT_EQ(truth.at(110.0)->x, 10.0);
  EXPECT_FALSE(TruthTrack{}.at(0.0));
}

TEST(TruthTrack, TurnsTheShortWayRound) {
  TruthTrack truth;
  truth.add(0.0, {0.0, 0.0, kPi - 0.1});
  truth.add(1.0, {0.0, 0.0, -kPi + 0.1});
  EXPECT_NEAR(std::abs(truth.at(0.5)->yaw), kPi, 1e-9);
}

TEST(LocalizationErrors, MeasureDistanceAndHeading) {
  const auto errors =
      errors_of({belief(103.0, {3.0, 0.5, 0.3}, true), belief(105.0, {5.0, 0.0, kPi / 2.0}, true),
                 belief(107.0, {0.0, 0.0, 0.0}, false), belief(120.0, {0.0, 0.0, 0.0}, false)},
                eastward());
  ASSERT_EQ(errors.size(), 3U) << "the truth at 120 s is not known";
  EXPECT_NEAR(errors[0].distance_m, 0.5, 1e-12);
  EXPECT_TRUE(errors[0].is_right());
  EXPECT_FALSE(errors[1].heading_is_right);
  EXPECT_FALSE(errors[1].is_right());
  EXPECT_NEAR(errors[2].distance_m, 7.0, 1e-12);
}

TEST(LocalizationErrors, AreOrderedAndTheLastBeliefOfAMomentCounts) {
  const auto errors =
      errors_of({belief(105.0, {9.0, 0.0, 0.0}, false), belief(103.0, {3.0, 0.0, 0.0}, false),
                 belief(105.0, {5.0, 0.0, 0.0}, false)},
                eastward());
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_EQ(errors[0].belief.stamp_s, 103.0);
  EXPECT_EQ(errors[1].distance_m, 0.0);
}

TEST(ErrorSummary, CountsWhatIsRightAndWhatOnlyClaimsToBe) {
  const auto errors =
      errors_of({belief(101.0, {9.0, 0.0, 0.0}, false), belief(102.0, {8.0, 0.0, 0.0}, true),
                 belief(103.0, {3.2, 0.0, 0.0}, false), belief(104.0, {4.1, 0.0, 0.0}, true),
                 belief(105.0, {5.0, 0.0, 3.0}, true)},
                eastward());
  const ErrorSummary s = summary_of(errors);
  EXPECT_EQ(s.beliefs, 5U);
  EXPECT_NEAR(s.duration_s, 4.0, 1e-12);
  EXPECT_NEAR(s.median_m, 0.2, 1e-9);
  EXPECT_NEAR(s.right_share, 0.4, 1e-12);
  EXPECT_NEAR(s.converged_share, 0.6, 1e-12);
  EXPECT_NEAR(s.false_share, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(*s.first_converged_s, 1.0, 1e-12);
  EXPECT_NEAR(*s.first_right_converged_s, 3.0, 1e-12);
  EXPECT_THAT(text_of(s), HasSubstr("first converged          after 1.0 s, rightly after 3.0 s"));
}

TEST(ErrorSummary, OfAFilterThatNeverConvergesSaysSo) {
  const auto errors = errors_of({belief(101.0, {9.0, 0.0, 0.0}, false)}, eastward());
  EXPECT_FALSE(summary_of(errors).first_converged_s);
  EXPECT_EQ(summary_of(errors).false_share, 0.0);
  EXPECT_THAT(text_of(summary_of(errors)), HasSubstr("never"));
  EXPECT_THROW(summary_of({}), std::invalid_argument);
}

TEST(ErrorTables, HaveARowForEachOrForSome) {
  std::vector<BeliefSample> beliefs;
  for (int i = 0; i < 100; ++i) {
    beliefs.push_back(belief(100.0 + 0.1 * i, {0.0, 0.0, 0.0}, false));
  }
  const auto errors = errors_of(beliefs, eastward());
  const std::string csv = csv_of(errors);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 101);
  EXPECT_THAT(csv, HasSubstr("\n100.000,0.000,1,0.1000,2.0000,0,0.000,"));
  const std::string table = table_of(errors, 10);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 11);
}

TEST(ErrorPlot, ShadesWhatHasConverged) {
  const auto errors =
      errors_of({belief(101.0, {1.0, 0.0, 0.0}, true), belief(103.0, {8.0, 0.0, 0.0}, true),
                 belief(106.0, {6.0, 0.0, 0.0}, false), belief(110.0, {6.0, 0.0, 0.0}, false)},
                eastward());
  const cv::Mat image = error_plot(errors, "test");
  const auto has = [&](const cv::Vec3b& colour) {
    return std::count(image.begin<cv::Vec3b>(), image.end<cv::Vec3b>(), colour) > 1000;
  };
  EXPECT_TRUE(has({215, 240, 210})) << "green: right";
  EXPECT_TRUE(has({215, 215, 250})) << "red: wrong";
  EXPECT_FALSE(error_plot({errors[0]}, "one belief").empty());
  const CoarseMap map{Grid<std::uint8_t>{30, 10}, 0.5};
  EXPECT_EQ(track_plot(errors, map).cols % 30, 0);
}

}  // namespace
}  // namespace cmn
