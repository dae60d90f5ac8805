// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/progress.hpp"

#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(Progress, SaysHowFarAndHowLongStill) {
  EXPECT_EQ(progress_line({48, 120, 0, 8.0, 0.8125}),
            "[########------------]  40 %  48/120  SR 0.81  6.0/s  12 s left");
  EXPECT_EQ(progress_line({1, 1000, 0, 4.0}),
            "[--------------------]   0 %  1/1000  15.0/min  1 h 06 min left");
}

TEST(Progress, WhatAnEarlierRunDidIsNotTakenForSpeed) {
  EXPECT_EQ(progress_line({60, 100, 50, 10.0}),
            "[############--------]  60 %  60/100  1.0/s  40 s left");
}

TEST(Progress, EstimatesNothingFromNothing) {
  EXPECT_EQ(progress_line({0, 100, 0, 3.0}), "[--------------------]   0 %  0/100");
  EXPECT_EQ(progress_line({50, 100, 50, 3.0}), "[##########----------]  50 %  50/100");
  EXPECT_EQ(progress_line({0, 0, 0, 0.0}), "[####################] 100 %  0/0");
}

TEST(Progress, TellsTheTimeTakenInTheEnd) {
  EXPECT_EQ(progress_line({100, 100, 0, 125.0, 0.5}),
            "[####################] 100 %  100/100  SR 0.50  48.0/min  2 min 05 s");
}

TEST(Progress, FitsATerminal) {
  EXPECT_LE(progress_line({123456, 1234567, 0, 1e7, 0.5}).size(), 79U);
}

}  // namespace
}  // namespace cmn
