// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/predicted_grid.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kLeast = 0.5;

LocalOccupancy square(int size, double side_m, float occupancy, float confidence) {
  LocalOccupancy result{size, side_m / size};
  result.stamp_s = 3.0;
  std::fill(result.occupancy.begin(), result.occupancy.end(), occupancy);
  std::fill(result.confidence.begin(), result.confidence.end(), confidence);
  return result;
}
PredictedOccupancy prediction() {
  return {square(kNearSize, kNearSide_m, 0.1F, 0.9F), square(kWideSize, kWideSide_m, 0.2F, 0.8F)};
}
std::size_t at(const LocalOccupancy& local, double x, double y) {
  return local.index_of(static_cast<int>(std::floor(x / local.resolution)) + local.size / 2,
                        static_cast<int>(std::floor(y / local.resolution)) + local.size / 2);
}

TEST(PredictedGrid, OnItsOwnGridThePredictionIsAsItWas) {
  PredictedOccupancy predicted = prediction();
  for (std::size_t i = 0; i < predicted.near.cell_count(); ++i) {
    predicted.near.occupancy[i] = static_cast<float>(i % 97) / 97.0F;
  }
  for (std::size_t i = 0; i < predicted.wide->cell_count(); ++i) {
    predicted.wide->occupancy[i] = static_cast<float>(i % 89) / 89.0F;
  }
  const LocalOccupancy near = laid_on_grid(predicted, {kNearSize, kNearSide_m, 0.0}, kLeast);
  EXPECT_EQ(near.occupancy, predicted.near.occupancy);
  EXPECT_EQ(near.confidence, predicted.near.confidence);
  EXPECT_EQ(near.stamp_s, 3.0);
  EXPECT_EQ(near.source, ObservationSource::kRgb);
  const LocalOccupancy wide = laid_on_grid(predicted, {kWideSize, kWideSide_m, 0.0}, kLeast);
  const std::size_t outside = at(wide, 1.02, -0.77);
  EXPECT_EQ(wide.occupancy[outside], predicted.wide->occupancy[outside]);
}

TEST(PredictedGrid, NearWhereItReachesWideAroundItNothingBeyond) {
  const LocalOccupancy grid = laid_on_grid(prediction(), {160, 16.0, 0.0}, kLeast);
  EXPECT_EQ(grid.occupancy[at(grid, 0.35, -0.55)], 0.1F);
  EXPECT_EQ(grid.occupancy[at(grid, 0.75, 0.05)], 0.2F);
  EXPECT_EQ(grid.confidence[at(grid, 1.55, 1.55)], 0.8F);
  EXPECT_EQ(grid.confidence[at(grid, 1.65, 0.05)], 0.0F);
  EXPECT_EQ(grid.occupancy[at(grid, 1.65, 0.05)], 1.0F);
}

TEST(PredictedGrid, WhatIsOutOfSightIsUnseenWhateverItsOccupancy) {
  PredictedOccupancy predicted = prediction();
  predicted.near = square(kNearSize, kNearSide_m, 0.0F, 0.49F);
  const LocalOccupancy grid = laid_on_grid(predicted, {kNearSize, kNearSide_m, 0.0}, kLeast);
  EXPECT_EQ(*std::max_element(grid.confidence.begin(), grid.confidence.end()), 0.0F);
  EXPECT_EQ(*std::min_element(grid.occupancy.begin(), grid.occupancy.end()), 1.0F);
}

TEST(PredictedGrid, ACoarserCellIsOccupiedWhereAnythingInSightIs) {
  PredictedOccupancy predicted = prediction();
  const std::size_t seen = at(predicted.near, 0.335, 0.125);
  const std::size_t hidden = at(predicted.near, -0.335, 0.125);
  predicted.near.occupancy[seen] = 0.95F;
  predicted.near.occupancy[hidden] = 0.95F;
  predicted.near.confidence[hidden] = 0.2F;
  const LocalOccupancy grid = laid_on_grid(predicted, {160, 16.0, 0.0}, kLeast);
  EXPECT_EQ(grid.occupancy[at(grid, 0.35, 0.15)], 0.95F);
  EXPECT_EQ(grid.occupancy[at(grid, -0.35, 0.15)], 0.1F);
}

TEST(PredictedGrid, AFinerCellIsTheOneThatItLiesIn) {
  PredictedOccupancy predicted = prediction();
  predicted.wide->occupancy[at(*predicted.wide, 1.0, 0.4)] = 0.7F;
  const LocalOccupancy grid = laid_on_grid(predicted, {320, 3.2, 0.0}, kLeast);
  for (const double off_m : {0.005, 0.025, 0.045}) {
    EXPECT_EQ(grid.occupancy[at(grid, 1.0 + off_m, 0.4 + off_m)], 0.7F) << off_m;
  }
  EXPECT_EQ(grid.occupancy[at(grid, 1.055, 0.405)], 0.2F);
}

TEST(PredictedGrid, ANetworkThatDoesNotLookFarLeavesTheRestUnseen) {
  PredictedOccupancy predicted = prediction();
  predicted.wide.reset();
  const LocalOccupancy grid = laid_on_grid(predicted, {kWideSize, kWideSide_m, 0.0}, kLeast);
  EXPECT_EQ(grid.occupancy[at(grid, 0.3, 0.3)], 0.1F);
  EXPECT_EQ(grid.confidence[at(grid, 0.9, 0.3)], 0.0F);
}

}  // namespace
}  // namespace cmn
