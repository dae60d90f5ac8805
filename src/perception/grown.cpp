// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/grown.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace cmn {

ProjectionParams with_margin(const ProjectionParams& grid, double by_m) {
  ProjectionParams wider = grid;
  const double cell_m = grid.side_m / grid.size;
  const int margin = static_cast<int>(std::ceil(by_m / cell_m));
  wider.size += 2 * margin;
  wider.side_m += 2 * margin * cell_m;
  return wider;
}

LocalOccupancy grown(LocalOccupancy seen, double by_m, int size) {
  assert(size <= seen.size && (seen.size - size) % 2 == 0);
  if (by_m <= 0.0 && size == seen.size) {
    return seen;
  }
  const int margin = (seen.size - size) / 2;
  LocalOccupancy middle{size, seen.resolution};
  middle.stamp_s = seen.stamp_s;
  middle.source = seen.source;
  for (int iy = 0; iy < size; ++iy) {
    for (int ix = 0; ix < size; ++ix) {
      const std::size_t from = seen.index_of(ix + margin, iy + margin);
      middle.occupancy[middle.index_of(ix, iy)] = seen.occupancy[from];
      middle.confidence[middle.index_of(ix, iy)] = seen.confidence[from];
    }
  }
  const double by = by_m / seen.resolution;
  const double half = 0.5 * (seen.size - 1);
  for (int iy = 0; iy < seen.size; ++iy) {
    for (int ix = 0; ix < seen.size; ++ix) {
      const std::size_t i = seen.index_of(ix, iy);
      if (seen.confidence[i] <= 0.0F || seen.occupancy[i] <= 0.5F) {
        continue;
      }
      const double reach = std::min(by + 0.5, std::hypot(ix - half, iy - half) - 1.0);
      const int most = static_cast<int>(std::floor(std::max(0.0, reach)));
      const int first_x = std::max(0, ix - margin - most);
      const int last_x = std::min(size - 1, ix - margin + most);
      const int last_y = std::min(size - 1, iy - margin + most);
      for (int y = std::max(0, iy - margin - most); y <= last_y; ++y) {
        const int dy = y + margin - iy;
        for (int x = first_x; x <= last_x; ++x) {
          const int dx = x + margin - ix;
          if (dx * dx + dy * dy <= reach * reach) {
            const std::size_t at = middle.index_of(x, y);
            middle.occupancy[at] = 1.0F;
            middle.confidence[at] = std::max(middle.confidence[at], seen.confidence[i]);
          }
        }
      }
    }
  }
  return middle;
}

}  // namespace cmn
