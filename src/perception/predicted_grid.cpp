// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/predicted_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cmn {
namespace {

/// Cells of a square from `first` up to `last`, along one axis.
struct Span {
  int first = 0;
  int last = 0;  ///< not among them; not above `first`: the square does not reach there
};

/// Those whose middles lie between two places [m] from the robot; where cells of the square are
/// larger than that, the one there.
Span span_of(const LocalOccupancy& square, double from_m, double to_m) {
  const double half = 0.5 * square.size;
  Span span;
  span.first = static_cast<int>(std::ceil(from_m / square.resolution + half - 0.5 - 1e-6));
  span.last = static_cast<int>(std::ceil(to_m / square.resolution + half - 0.5 - 1e-6));
  if (span.last <= span.first) {
    span.first = static_cast<int>(std::floor(0.5 * (from_m + to_m) / square.resolution + half));
    span.last = span.first + 1;
  }
  return {std::max(span.first, 0), std::min(span.last, square.size)};
}

/// Copies what counts of the square's cells in x and y into a cell of the grid.
void take(const LocalOccupancy& square, const Span& x, const Span& y, double least_in_sight,
          LocalOccupancy& grid, std::size_t to) {
  for (int iy = y.first; iy < y.last; ++iy) {
    for (int ix = x.first; ix < x.last; ++ix) {
      const std::size_t from = square.index_of(ix, iy);
      if (square.confidence[from] < least_in_sight) {
        continue;
      }
      if (grid.confidence[to] == 0.0F || square.occupancy[from] > grid.occupancy[to]) {
        grid.occupancy[to] = square.occupancy[from];
        grid.confidence[to] = square.confidence[from];
      }
    }
  }
}

}  // namespace

LocalOccupancy laid_on_grid(const PredictedOccupancy& predicted, const ProjectionParams& params,
                            double least_in_sight) {
  LocalOccupancy grid{params.size, params.side_m / params.size};
  grid.stamp_s = predicted.near.stamp_s;
  grid.source = ObservationSource::kRgb;
  std::fill(grid.occupancy.begin(), grid.occupancy.end(), 1.0F);
  const double half = 0.5 * params.size;
  const auto edge_m = [&](int i) { return (i - half) * grid.resolution; };
  const double near_m = 0.5 * predicted.near.side_m();
  for (int iy = 0; iy < params.size; ++iy) {
    for (int ix = 0; ix < params.size; ++ix) {
      const bool is_near = std::max(std::abs(edge_m(ix) + edge_m(ix + 1)),
                                    std::abs(edge_m(iy) + edge_m(iy + 1))) < 2.0 * near_m;
      if (!is_near && !predicted.wide) {
        continue;
      }
      const LocalOccupancy& square = is_near ? predicted.near : *predicted.wide;
      take(square, span_of(square, edge_m(ix), edge_m(ix + 1)),
           span_of(square, edge_m(iy), edge_m(iy + 1)), least_in_sight, grid,
           grid.index_of(ix, iy));
    }
  }
  return grid;
}

}  // namespace cmn
