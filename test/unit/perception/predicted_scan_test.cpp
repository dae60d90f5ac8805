// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/predicted_scan.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace cmn {
namespace {

/// P(free and in sight) by place.
using Rule = std::function<double(Point2)>;

LocalOccupancy square_of(int size, double side_m, const Rule& p_free) {
  LocalOccupancy square{size, side_m / size};
  square.stamp_s = 3.0;
  for (int iy = 0; iy < size; ++iy) {
    for (int ix = 0; ix < size; ++ix) {
      const Point2 p{(ix + 0.5 - 0.5 * size) * square.resolution,
                     (iy + 0.5 - 0.5 * size) * square.resolution};
      square.confidence[square.index_of(ix, iy)] = 0.98F;
      square.occupancy[square.index_of(ix, iy)] = 1.0F - static_cast<float>(p_free(p)) / 0.98F;
    }
  }
  return square;
}
PredictedOccupancy prediction_of(const Rule& p_free) {
  return {square_of(kNearSize, kNearSide_m, p_free), square_of(kWideSize, kWideSide_m, p_free)};
}

ColorPanorama all_round() {
  ColorPanorama panorama;
  for (cv::Mat& view : panorama.views) {
    view.setTo(cv::Scalar::all(90));
  }
  return panorama;
}
RangeScan scan_of(const PredictedOccupancy& predicted) {
  return predicted_scan(predicted, all_round(), RgbParams{});
}

/// Free up to a range that is known with this 10 to 90 % spread.
Rule wall_at(double range_m, double spread_m) {
  return
      [=](Point2 p) { return std::clamp(0.5 + 0.8 * (range_m - norm(p)) / spread_m, 0.02, 0.97); };
}

std::size_t ahead() { return 180; }  // -pi + 180 degrees

TEST(PredictedScan, TheMedianOfWhereTheGroundEndsIsTheRange) {
  for (const double range_m : {0.3, 0.5, 0.9, 1.3}) {
    SCOPED_TRACE(range_m);
    const RangeScan scan = scan_of(prediction_of(wall_at(range_m, 0.2)));
    ASSERT_EQ(scan.ranges_m.size(), 360U);
    for (const float measured_m : scan.ranges_m) {
      EXPECT_NEAR(measured_m, range_m, 0.04);
    }
    EXPECT_EQ(scan.stamp_s, 3.0);
    EXPECT_EQ(scan.source, ObservationSource::kRgb);
  }
}

TEST(PredictedScan, ARangeThatIsHardlyKnownIsNoneAndTheGroundIsFreeUpToIt) {
  const RangeScan scan = scan_of(prediction_of(wall_at(0.9, 0.8)));
  EXPECT_EQ(scan.ranges_m[ahead()], std::numeric_limits<float>::infinity());
  EXPECT_NEAR(scan.sights[ahead()].to_m, 0.5, 0.06) << "free with 90 %";
}

TEST(PredictedScan, WhereNothingStandsItIsFreeUpToTheBorder) {
  const RangeScan scan = scan_of(prediction_of([](Point2) { return 0.97; }));
  EXPECT_GT(scan.ranges_m[ahead()], scan.range_max_m);
  EXPECT_NEAR(scan.sights[ahead()].to_m, 1.6, 0.03);
  EXPECT_NEAR(scan.sights[ahead() + 45].to_m, 1.6 * std::sqrt(2.0), 0.03);
}

TEST(PredictedScan, WhereNoViewLooksNothingIsMeasured) {
  ColorPanorama panorama = all_round();
  panorama.views[1] = cv::Mat::zeros(kViewSide, kViewSide, CV_8UC3);
  panorama.views[2].colRange(0, kViewSide / 4).setTo(cv::Scalar::all(0));
  const RangeScan scan = predicted_scan(prediction_of(wall_at(0.9, 0.2)), panorama, RgbParams{});
  const auto is_known = [&](double bearing_deg) {
    return !std::isnan(scan.ranges_m[static_cast<std::size_t>(180.0 + bearing_deg)]);
  };
  EXPECT_TRUE(is_known(0.0) && is_known(-90.0) && is_known(44.0) && is_known(179.0));
  EXPECT_FALSE(is_known(90.0) || is_known(46.0) || is_known(134.0)) << "the black view";
  EXPECT_TRUE(is_known(136.0));
  EXPECT_FALSE(is_known(-136.0)) << "the left of the view to the back is to the robot's right";
}

TEST(PredictedScan, WhatIsNotFreeFromTheBeginningIsNotKnown) {
  const RangeScan scan =
      scan_of(prediction_of([](Point2 p) { return p.x > std::abs(p.y) ? 0.95 : 0.05; }));
  EXPECT_GT(scan.sights[ahead()].to_m, 1.5F);
  EXPECT_TRUE(std::isnan(scan.ranges_m[ahead() + 90]));
  EXPECT_TRUE(std::isnan(scan.ranges_m[0]));
}

TEST(PredictedScan, ANetworkThatDoesNotLookFarSeesToTheNearBorder) {
  PredictedOccupancy predicted = prediction_of([](Point2) { return 0.97; });
  predicted.wide.reset();
  const RangeScan scan = scan_of(predicted);
  EXPECT_NEAR(scan.sights[ahead()].to_m, 0.64, 0.02);
}

}  // namespace
}  // namespace cmn
