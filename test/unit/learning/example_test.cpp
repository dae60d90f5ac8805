// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/example.hpp"

#include "learning_examples.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

bool is_seen(const cv::Mat& truth, int ix, int iy) {
  return (truth.at<std::uint8_t>(iy, ix) & kTruthSeen) != 0;
}

bool are_equal(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0.0; }

TEST(MarkSeen, AWallHidesWhatIsBehindIt) {
  cv::Mat truth = cv::Mat::zeros(kWideSize, kWideSize, CV_8UC1);
  truth.col(44).setTo(kTruthOccupied);  // a wall of one cell, 0.6 m ahead
  mark_seen(truth, kWideSide_m, kPi / 2.0);
  EXPECT_TRUE(is_seen(truth, 40, 32));
  EXPECT_TRUE(is_seen(truth, 44, 32)) << "the wall itself";
  EXPECT_FALSE(is_seen(truth, 50, 32)) << "behind it";
  EXPECT_TRUE(is_seen(truth, 10, 32)) << "behind the robot";
}

TEST(MarkSeen, ASolidBodyIsKnownToADepthOfTenCentimetres) {
  cv::Mat truth = cv::Mat::zeros(kNearSize, kNearSize, CV_8UC1);
  truth.colRange(100, kNearSize).setTo(kTruthOccupied);
  mark_seen(truth, kNearSide_m, kPi / 2.0);
  EXPECT_TRUE(is_seen(truth, 109, 64));
  EXPECT_FALSE(is_seen(truth, 111, 64));
}

TEST(MarkSeen, NarrowViewsLeaveGapsBetweenThem) {
  cv::Mat truth = cv::Mat::zeros(kNearSize, kNearSize, CV_8UC1);
  mark_seen(truth, kNearSide_m, kPi / 3.0);
  EXPECT_TRUE(is_seen(truth, 120, 64));
  EXPECT_TRUE(is_seen(truth, 64, 120));
  EXPECT_FALSE(is_seen(truth, 110, 110));
}

TEST(MarkSeen, IsTheSameWhicheverWayTheRobotFaces) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    Example example;
    for (int i = 0; i < 12; ++i) {
      const auto x = static_cast<int>(draw_index(rng, kWideSize - 6));
      const auto y = static_cast<int>(draw_index(rng, kWideSize - 6));
      example.wide(cv::Rect{x, y, 5, 3}).setTo(kTruthOccupied);
    }
    example.wide(cv::Rect{29, 29, 6, 6}).setTo(0);
    Example first_turned = turned(example, 1);
    mark_seen(example.wide, kWideSide_m, kPi / 2.0);
    mark_seen(first_turned.wide, kWideSide_m, kPi / 2.0);
    EXPECT_TRUE(are_equal(turned(example, 1).wide, first_turned.wide));
  }
}

TEST(Example, FourTurnsAndTwoMirrorsAreNone) {
  std::mt19937_64 rng{1};
  const Example example = toy_example(rng);
  const Example around = turned(turned(turned(turned(example, 1), 1), 1), 1);
  const Example twice = mirrored(mirrored(example));
  for (const Example& same : {around, twice, turned(example, -4)}) {
    EXPECT_TRUE(are_equal(same.near, example.near));
    EXPECT_TRUE(are_equal(same.wide, example.wide));
    for (std::size_t k = 0; k < kViewCount; ++k) {
      EXPECT_TRUE(are_equal(same.panorama.views[k], example.panorama.views[k]));
    }
  }
}

TEST(Example, WhatWasToTheLeftIsAheadAfterALeftTurn) {
  Example example;
  add_wall(example.near, kNearSide_m, 1, 0.3);
  Example expected;
  add_wall(expected.near, kNearSide_m, 0, 0.3);
  EXPECT_TRUE(are_equal(turned(example, 1).near, expected.near));
}

TEST(Example, TheMirrorImageHasItsWallOnTheOtherSide) {
  Example example;
  example.panorama.views[1].setTo(cv::Scalar::all(200));
  add_wall(example.near, kNearSide_m, 1, 0.3);
  Example expected;
  add_wall(expected.near, kNearSide_m, 3, 0.3);
  const Example mirror = mirrored(example);
  EXPECT_TRUE(are_equal(mirror.near, expected.near));
  EXPECT_EQ(mirror.panorama.views[3].at<cv::Vec3b>(0, 0)[0], 200);
  EXPECT_EQ(mirror.panorama.views[1].at<cv::Vec3b>(0, 0)[0], 0);
}

TEST(Example, NothingIsInSightWhereAViewIsBlack) {
  std::mt19937_64 rng{2};
  Example example = toy_example(rng);
  example.near.setTo(kTruthSeen);
  example.wide.setTo(kTruthSeen | kTruthOccupied);
  const Example ahead_alone = blacked_out(example, {false, true, true, true});
  EXPECT_TRUE(are_equal(ahead_alone.panorama.views[0], example.panorama.views[0]));
  for (std::size_t k = 1; k < kViewCount; ++k) {
    EXPECT_EQ(cv::norm(ahead_alone.panorama.views[k], cv::NORM_INF), 0.0) << "view " << k;
  }
  EXPECT_TRUE(is_seen(ahead_alone.near, 100, 64));
  EXPECT_TRUE(is_seen(ahead_alone.near, 100, 100)) << "on the diagonal, at the view's border";
  EXPECT_FALSE(is_seen(ahead_alone.near, 99, 100)) << "left of the diagonal";
  EXPECT_FALSE(is_seen(ahead_alone.near, 20, 64)) << "behind";
  EXPECT_FALSE(is_seen(ahead_alone.near, 20, 20));
  EXPECT_EQ(ahead_alone.wide.at<std::uint8_t>(32, 10), kTruthOccupied) << "only its sight is gone";
}

TEST(Example, BlackViewsTurnWithTheRobot) {
  std::mt19937_64 rng{3};
  Example example = toy_example(rng);
  mark_seen(example.near, kNearSide_m, kPi / 2.0);
  mark_seen(example.wide, kWideSide_m, kPi / 2.0);
  const Example left_black = turned(blacked_out(example, {false, true, false, false}), 1);
  const Example ahead_black = blacked_out(turned(example, 1), {true, false, false, false});
  EXPECT_TRUE(are_equal(left_black.near, ahead_black.near));
  EXPECT_TRUE(are_equal(left_black.wide, ahead_black.wide));
  for (std::size_t k = 0; k < kViewCount; ++k) {
    EXPECT_TRUE(are_equal(left_black.panorama.views[k], ahead_black.panorama.views[k]));
  }
}

}  // namespace
}  // namespace cmn
