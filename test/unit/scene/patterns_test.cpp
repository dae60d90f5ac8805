// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/patterns.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

using Draw = cv::Mat (*)(std::mt19937_64&);

class Pattern : public testing::TestWithParam<Draw> {
 protected:
  static cv::Mat draw(std::uint64_t seed) {
    std::mt19937_64 rng{seed};
    return GetParam()(rng);
  }
  static cv::Scalar deviation(const cv::Mat& pattern) {
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(pattern, mean, deviation);
    return deviation;
  }
};

TEST_P(Pattern, IsASquareOfOpaqueTexels) {
  const cv::Mat pattern = draw(1);
  ASSERT_EQ(pattern.type(), CV_8UC4);
  EXPECT_EQ(pattern.rows, pattern.cols);
  std::vector<cv::Mat> channels;
  cv::split(pattern, channels);
  EXPECT_EQ(cv::countNonZero(channels[3] != 255), 0) << "a floor has no holes";
}

TEST_P(Pattern, IsTheSeedsAndEachSeedHasItsOwn) {
  EXPECT_EQ(cv::norm(draw(7), draw(7)), 0.0);
  EXPECT_GT(cv::norm(draw(7), draw(8)), 0.0);
}

TEST_P(Pattern, HasJointsAndGrain) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const cv::Scalar spread = deviation(draw(seed));
    EXPECT_GT(spread[0] + spread[1] + spread[2], 6.0) << "a plain area";
    EXPECT_LT(spread[2], 80.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Floors, Pattern, testing::Values(plank_pattern, tile_pattern));

}  // namespace
}  // namespace cmn
