// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/prediction_score.hpp"

#include "coarse_map_nav/learning/example.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(ScoreHistogram, AveragePrecisionByHand) {
  ScoreHistogram scores;
  scores.add(0.9F, true);
  scores.add(0.8F, false);
  scores.add(0.7F, true);
  scores.add(0.1F, false);
  // Recall rises by a half at precision 1, by another at 2/3.
  EXPECT_NEAR(scores.average_precision(), 0.5 * 1.0 + 0.5 * 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(scores.intersection_over_union(), 2.0 / 3.0, 1e-12);
}

TEST(ScoreHistogram, AConstantScoreHasTheShareOfPositivesAsAveragePrecision) {
  ScoreHistogram scores;
  for (int i = 0; i < 10; ++i) {
    scores.add(1.0F, i < 7);
  }
  EXPECT_NEAR(scores.average_precision(), 0.7, 1e-12);
  EXPECT_NEAR(scores.positive_share(), 0.7, 1e-12);
  EXPECT_NEAR(scores.calibration_error(), 0.3, 1e-12);
}

TEST(ScoreHistogram, IsCalibratedWhenAsManyArePositiveAsItSays) {
  ScoreHistogram scores;
  for (int i = 0; i < 100; ++i) {
    scores.add(0.2F, i < 20);
    scores.add(0.9F, i < 90);
  }
  EXPECT_NEAR(scores.calibration_error(), 0.0, 1e-12);
}

TEST(ScoreHistogram, HasNoFiguresWithoutCells) {
  const ScoreHistogram none;
  EXPECT_TRUE(std::isnan(none.average_precision()));
  EXPECT_TRUE(std::isnan(none.calibration_error()));
  EXPECT_TRUE(std::isnan(none.intersection_over_union()));
}

TEST(SquareScore, JudgesOccupancyWhereItIsInSightAlone) {
  LocalOccupancy predicted{2, 0.1};
  predicted.occupancy = {0.1F, 0.9F, 0.9F, 0.1F};
  predicted.confidence = {1.0F, 1.0F, 0.0F, 0.0F};
  // Right in sight, wrong behind.
  const cv::Mat truth =
      (cv::Mat_<std::uint8_t>(2, 2) << kTruthSeen, kTruthSeen | kTruthOccupied, 0, kTruthOccupied);
  SquareScore score;
  score.add(predicted, truth);
  EXPECT_EQ(score.seen.count(), 2.0);
  EXPECT_NEAR(score.seen.average_precision(), 1.0, 1e-12);
  EXPECT_NEAR(score.seen.intersection_over_union(), 1.0, 1e-12);
  EXPECT_NEAR(score.occupied.intersection_over_union(), 1.0, 1e-12);
  EXPECT_EQ(score.all.count(), 4.0);
  EXPECT_NEAR(score.in_sight.average_precision(), 1.0, 1e-12);
}

}  // namespace
}  // namespace cmn
