// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/data/local_occupancy.hpp"

namespace cmn {

std::vector<Point2> surface_of(const LocalOccupancy& seen) {
  std::vector<Point2> points;
  const auto is_free = [&](int ix, int iy) {
    const std::size_t i = seen.index_of(ix, iy);
    return seen.confidence[i] > 0.0F && seen.occupancy[i] <= 0.5F;
  };
  for (int iy = 1; iy + 1 < seen.size; ++iy) {
    for (int ix = 1; ix + 1 < seen.size; ++ix) {
      const std::size_t i = seen.index_of(ix, iy);
      if (seen.confidence[i] > 0.0F && seen.occupancy[i] > 0.5F &&
          (is_free(ix - 1, iy) || is_free(ix + 1, iy) || is_free(ix, iy - 1) ||
           is_free(ix, iy + 1))) {
        points.push_back({(ix + 0.5 - 0.5 * seen.size) * seen.resolution,
                          (iy + 0.5 - 0.5 * seen.size) * seen.resolution});
      }
    }
  }
  return points;
}

}  // namespace cmn
