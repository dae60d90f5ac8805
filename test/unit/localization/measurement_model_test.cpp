// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/measurement_model.hpp"

#include "coarse_map_nav/localization/neighbourhood.hpp"

#include <cmath>
#include <numeric>

#include "random_case.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(Reduce, AveragesBlocksExactlyWhereTheyDoNotDivideTheGrid) {
  // 4 cells onto 3: each coarse cell is one whole fine cell and a third of a neighbour.
  LocalOccupancy seen{4, 0.32};
  for (int iy = 0; iy < 4; ++iy) {
    for (int ix = 0; ix < 4; ++ix) {
      seen.occupancy[seen.index_of(ix, iy)] = ix == 3 ? 1.0F : 0.0F;
      seen.confidence[seen.index_of(ix, iy)] = 1.0F;
    }
  }
  const std::vector<double> window = reduce(seen, MeasurementModelParams{}, 0.0);
  EXPECT_NEAR(window[0], 0.0, 1e-12);
  EXPECT_NEAR(window[1], 0.0, 1e-12);
  EXPECT_NEAR(window[2], 0.75, 1e-12);
}

TEST(Reduce, KeepsTheMeanOfTheWholeGrid) {
  std::mt19937_64 rng{5};
  for (const int size : {3, 5, 7, 32, 128}) {
    const LocalOccupancy seen = random_observation(rng, size);
    const std::vector<double> window = reduce(seen, MeasurementModelParams{}, 0.0);
    const double mean = std::accumulate(seen.occupancy.begin(), seen.occupancy.end(), 0.0) /
                        static_cast<double>(seen.cell_count());
    EXPECT_NEAR(std::accumulate(window.begin(), window.end(), 0.0) / 9.0, mean, 1e-9) << size;
  }
}

TEST(Reduce, TurnsTheObservationBackByTheResidualYaw) {
  // A wall ahead of a robot turned 30 degrees left of the axis lies 30 degrees left of it.
  LocalOccupancy seen{128, 0.01};
  const double residual = kPi / 6.0;
  const Point2 obstacle =
      turned(Point2{0.43, 0.0}, -residual);  // on the axis, in the robot's frame
  for (int iy = 0; iy < seen.size; ++iy) {
    for (int ix = 0; ix < seen.size; ++ix) {
      const Point2 p{(ix - 63.5) * 0.01, (iy - 63.5) * 0.01};
      seen.occupancy[seen.index_of(ix, iy)] = norm(p - obstacle) < 0.15 ? 1.0F : 0.0F;
      seen.confidence[seen.index_of(ix, iy)] = 1.0F;
    }
  }
  const std::vector<double> window = reduce(seen, MeasurementModelParams{}, residual);
  EXPECT_GT(window[5], 0.3);  // straight ahead along the axis
  EXPECT_LT(window[2], 0.1);
  EXPECT_LT(window[8], 0.1);
}

TEST(Reduce, UnseenCellsAreOccupiedOrSayNothing) {
  LocalOccupancy seen{3, 1.28 / 3};
  seen.occupancy.assign(9, 1.0F);
  seen.occupancy[0] = 0.0F;
  seen.confidence[0] = 1.0F;
  MeasurementModelParams params;
  EXPECT_EQ(reduce(seen, params, 0.0)[4], 1.0);
  params.unseen_is_occupied = false;
  EXPECT_EQ(reduce(seen, params, 0.0)[4], 0.5);
  EXPECT_EQ(reduce(seen, params, 0.0)[0], 0.0);
}

TEST(OverlapModel, APerfectMatchHasLikelihoodOneAndItsOppositeZero) {
  std::mt19937_64 rng{11};
  const CoarseMap map = random_map(rng, 6, 6);
  for (const int reach : {0, 1, 2}) {
    MeasurementModelParams params;
    params.window_reach = reach;
    const int n = params.window_cells();
    OverlapModel model{map, params};
    const Belief layout{map.width(), map.height()};
    const Cell c{2, 3};
    LocalOccupancy seen{n, 1.28 / n};
    LocalOccupancy opposite = seen;
    for (int iy = 0; iy < n; ++iy) {
      for (int ix = 0; ix < n; ++ix) {
        const bool occupied = map.is_occupied(c + turned(Cell{ix - reach, iy - reach}, 1));
        seen.occupancy[seen.index_of(ix, iy)] = occupied ? 1.0F : 0.0F;
        opposite.occupancy[seen.index_of(ix, iy)] = occupied ? 0.0F : 1.0F;
      }
    }
    const auto north = static_cast<std::size_t>(index(Heading::kNorth));
    const std::size_t kind = model.kinds().of_cell[layout.padded_index(c)];
    const auto at = [&](const Likelihood& likelihood) { return likelihood[north][kind]; };
    EXPECT_NEAR(at(model.measure(seen, 0.0, 1.0, kAllHeadings)), 1.0, 1e-12) << n;
    EXPECT_EQ(at(model.measure(opposite, 0.0, 1.0, kAllHeadings)), 0.0) << n;
  }
}

}  // namespace
}  // namespace cmn
