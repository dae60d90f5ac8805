// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/run_record.hpp"

#include <gtest/gtest.h>

namespace cmn {
namespace {

RunMoment moment_at(double time_s) {
  RunMoment moment;
  moment.time_s = time_s;
  moment.marginal = Grid<float>(1, 1, static_cast<float>(time_s));
  return moment;
}

TEST(RunRecord, KeepsFirstAndLastMomentAndSpreadsTheRestEvenly) {
  RunRecord record;
  for (int i = 0; i < 5000; ++i) {
    record.add(moment_at(i));
    ASSERT_LE(record.moments().size(), RunRecord::kMostMoments);
    ASSERT_EQ(record.moments().front().time_s, 0.0);
    ASSERT_EQ(record.moments().back().time_s, i);
  }
  EXPECT_GT(record.moments().size(), RunRecord::kMostMoments / 3);
  for (const RunMoment& moment : record.moments()) {
    ASSERT_EQ(moment.marginal.size(), 1U) << "at " << moment.time_s;
    EXPECT_EQ(moment.marginal[0], static_cast<float>(moment.time_s));
  }
  const double step = record.moments()[1].time_s;
  for (std::size_t i = 1; i + 1 < record.moments().size(); ++i) {
    EXPECT_EQ(record.moments()[i].time_s - record.moments()[i - 1].time_s, step);
  }
}

TEST(RunRecord, MeasuresTheWayOnSparsePoints) {
  RunRecord record;
  for (int i = 0; i <= 1000; ++i) {
    record.add(TrackPoint{0.01 * i, Pose2{0.003 * i, 0.0, 0.0}});
  }
  EXPECT_LT(record.track().size(), 200U);
  EXPECT_NEAR(record.driven_m(), 3.0, 0.02);
  EXPECT_NEAR(record.duration_s(), 10.0, 0.1);
}

TEST(RunRecord, KnowsTheTruthFromItsFirstPointOn) {
  RunRecord record;
  EXPECT_FALSE(record.truth_at(1.0).has_value());
  record.add(TrackPoint{1.0, Pose2{1.0, 0.0, 0.0}});
  record.add(TrackPoint{2.0, Pose2{2.0, 0.0, 0.0}});
  EXPECT_FALSE(record.truth_at(0.9).has_value());
  EXPECT_EQ(record.truth_at(1.5)->x, 1.0);
  EXPECT_EQ(record.truth_at(9.0)->x, 2.0);
}

}  // namespace
}  // namespace cmn
