// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/clearance_map.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

/// All free, of 0.1 m cells.
LocalOccupancy hall(int size) {
  LocalOccupancy seen{size, 0.1};
  std::fill(seen.occupancy.begin(), seen.occupancy.end(), 0.0F);
  std::fill(seen.confidence.begin(), seen.confidence.end(), 1.0F);
  return seen;
}

TEST(ClearanceMap, ReachesFromTheMiddleOfACellToTheBorderOfTheNearestOccupiedOne) {
  LocalOccupancy seen = hall(21);
  seen.occupancy[seen.index_of(10, 10)] = 1.0F;
  ClearanceMap map;
  map.measure(seen, 0.5);
  EXPECT_EQ(map.at_cell(10, 10), 0.0);
  EXPECT_NEAR(map.at_cell(14, 10), 0.35, 1e-3);
  EXPECT_NEAR(map.at_cell(13, 6), 0.45, 0.01);
  EXPECT_NEAR(map.at({-0.5, 0.0}), 0.45, 1e-3);
}

TEST(ClearanceMap, KnowsWhatIsTooNearToAWallAlsoWhereItWasNotSeen) {
  LocalOccupancy seen = hall(21);
  for (int iy = 0; iy < seen.size; ++iy) {
    seen.occupancy[seen.index_of(15, iy)] = 1.0F;
    for (int ix = 16; ix < seen.size; ++ix) {
      seen.confidence[seen.index_of(ix, iy)] = 0.0F;
    }
  }
  ClearanceMap map;
  map.measure(seen, 0.5);
  EXPECT_EQ(map.at_cell(16, 10), ClearanceMap::kUnseen);
  EXPECT_TRUE(map.is_nearer_than(0.19, seen.index_of(16, 10)));
  EXPECT_TRUE(map.is_nearer_than(0.19, seen.index_of(14, 10)));
  EXPECT_FALSE(map.is_nearer_than(0.19, seen.index_of(18, 10)));
  EXPECT_FALSE(map.is_nearer_than(0.19, seen.index_of(12, 10)));
}

TEST(ClearanceMap, IsLargeEverywhereWhereNothingIsOccupied) {
  ClearanceMap map;
  map.measure(hall(5), 0.5);
  EXPECT_GT(map.at({0.2, -0.2}), 100.0);
}

TEST(ClearanceMap, IsToTheBitThatOfOpenCvUpToTheFarthestAskedFor) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    LocalOccupancy seen = hall(3 + static_cast<int>(draw_index(rng, 60)));
    const double density = std::pow(draw_uniform(rng), 4.0);
    cv::Mat is_free(seen.size, seen.size, CV_8U, cv::Scalar{255});
    for (std::size_t i = 0; i < seen.cell_count(); ++i) {
      if (draw_uniform(rng) < density) {
        seen.occupancy[i] = 1.0F;
        is_free.data[i] = 0;
      }
    }
    cv::Mat distance;
    cv::distanceTransform(is_free, distance, cv::DIST_L2, cv::DIST_MASK_5, CV_32F);
    const double farthest_m = 3.0 * draw_uniform(rng);
    ClearanceMap map;
    map.measure(seen, farthest_m);
    for (int iy = 0; iy < seen.size; ++iy) {
      for (int ix = 0; ix < seen.size; ++ix) {
        const float expected_m =
            std::max(0.0F, distance.at<float>(iy, ix) - 0.5F) * static_cast<float>(seen.resolution);
        const double found_m = map.at_cell(ix, iy);
        if (static_cast<double>(expected_m) <= farthest_m) {
          ASSERT_EQ(found_m, static_cast<double>(expected_m)) << ix << " " << iy;
        } else {
          ASSERT_GE(found_m, static_cast<double>(expected_m)) << ix << " " << iy;
        }
      }
    }
  }
}

TEST(ClearanceMap, IsUnseenOutside) {
  ClearanceMap map;
  map.measure(LocalOccupancy{5, 0.1}, 0.5);
  EXPECT_EQ(map.at({0.26, 0.0}), ClearanceMap::kUnseen);
  EXPECT_EQ(map.at({0.0, -0.26}), ClearanceMap::kUnseen);
}

}  // namespace
}  // namespace cmn
