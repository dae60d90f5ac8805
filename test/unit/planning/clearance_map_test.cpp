// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/clearance_map.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

/// `share` of the cells occupied, and as many unseen.
LocalOccupancy random_view(std::mt19937_64& rng, int size, double resolution, double share) {
  LocalOccupancy seen{size, resolution};
  for (std::size_t i = 0; i < seen.cell_count(); ++i) {
    seen.occupancy[i] = draw_uniform(rng) < share ? 1.0F : 0.0F;
    seen.confidence[i] = draw_uniform(rng) < share ? 0.0F : 1.0F;
  }
  return seen;
}

/// By OpenCV's chamfer distance over the whole grid.
float clearance_m(const LocalOccupancy& seen, std::size_t cell, double most_m) {
  if (seen.confidence[cell] <= 0.0F) {
    return static_cast<float>(ClearanceMap::kUnseen);
  }
  cv::Mat is_free(seen.size, seen.size, CV_8U);
  for (std::size_t i = 0; i < seen.cell_count(); ++i) {
    is_free.data[i] = seen.confidence[i] > 0.0F && seen.occupancy[i] > 0.5F ? 0 : 255;
  }
  cv::Mat distance;
  cv::distanceTransform(is_free, distance, cv::DIST_L2, cv::DIST_MASK_5, CV_32F);
  const float clear_m = std::max(0.0F, reinterpret_cast<const float*>(distance.data)[cell] - 0.5F) *
                        static_cast<float>(seen.resolution);
  return static_cast<double>(clear_m) <= most_m ? clear_m : std::numeric_limits<float>::infinity();
}

TEST(ClearanceMap, IsTheChamferDistanceOfTheWholeGridHoweverFarItReaches) {
  std::mt19937_64 rng{1};
  ClearanceMap map;  // one for all: nothing of one view may stay for the next
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const int size = 1 + static_cast<int>(draw_index(rng, 40));
    const LocalOccupancy seen = random_view(rng, size, 0.05, draw_uniform(rng) * draw_uniform(rng));
    const double most_m = draw_uniform(rng);  // 0 to 20 cells: stamps of one row, of two, none
    map.measure(seen, most_m);
    for (std::size_t cell = 0; cell < seen.cell_count(); cell += 1 + draw_index(rng, 20)) {
      EXPECT_EQ(static_cast<float>(map.at_cell(cell)), clearance_m(seen, cell, most_m))
          << "cell " << cell << " of " << size << " x " << size << " up to " << most_m << " m";
    }
  }
}

TEST(ClearanceMap, IsInfiniteEverywhereWhereNothingIsOccupied) {
  LocalOccupancy seen{5, 0.1};
  std::fill(seen.occupancy.begin(), seen.occupancy.end(), 0.0F);
  std::fill(seen.confidence.begin(), seen.confidence.end(), 1.0F);
  ClearanceMap map;
  map.measure(seen, 0.3);
  EXPECT_EQ(map.at({0.2, -0.2}), std::numeric_limits<double>::infinity());
}

TEST(ClearanceMap, IsUnseenOutside) {
  ClearanceMap map;
  map.measure(LocalOccupancy{5, 0.1}, 0.3);
  EXPECT_EQ(map.at({0.26, 0.0}), ClearanceMap::kUnseen);
  EXPECT_EQ(map.at({0.0, -0.26}), ClearanceMap::kUnseen);
}

}  // namespace
}  // namespace cmn
