// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/motion/rest_detector.hpp"

#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(RestDetector, SeesRestOnlyAfterATenthOfASecond) {
  RestDetector rest;
  EXPECT_FALSE(rest.at_rest());
  rest.update({5.00, {}});
  EXPECT_FALSE(rest.at_rest());
  rest.update({5.09, {}});
  EXPECT_FALSE(rest.at_rest());
  rest.update({5.11, {}});
  EXPECT_TRUE(rest.at_rest());
}

TEST(RestDetector, IsNotFooledByASampleThatIsRepeated) {
  RestDetector rest;
  for (int i = 0; i < 100; ++i) {
    rest.update({5.0, {}});
  }
  EXPECT_FALSE(rest.at_rest());
}

TEST(RestDetector, SeesACreepThatIsTooSlowFromOneSampleToTheNext) {
  RestDetector rest;
  for (int i = 0; i < 100; ++i) {
    rest.update({0.01 * i, {0.0002 * i, 0.0, 0.0}});  // 0.2 mm a sample
    EXPECT_FALSE(rest.at_rest());
  }
}

TEST(RestDetector, SeesATurnAcrossHalfATurn) {
  RestDetector rest;
  rest.update({0.0, {0.0, 0.0, kPi - 1e-5}});
  rest.update({0.2, {0.0, 0.0, -kPi + 1e-5}});
  EXPECT_TRUE(rest.at_rest()) << "a hair's breadth across the seam is not a motion";
  rest.update({0.3, {0.0, 0.0, -kPi + 0.01}});
  EXPECT_FALSE(rest.at_rest());
}

TEST(RestDetector, BeginsAnewWhenTimeRunsBackwards) {
  RestDetector rest;
  rest.update({100.0, {}});
  rest.update({101.0, {}});
  ASSERT_TRUE(rest.at_rest());
  rest.update({3.0, {}});
  EXPECT_FALSE(rest.at_rest());
}

}  // namespace
}  // namespace cmn
