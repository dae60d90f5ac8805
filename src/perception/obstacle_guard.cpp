// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/obstacle_guard.hpp"

namespace cmn {

double occupied_share_ahead(const LocalOccupancy& seen) {
  const int third = seen.size / 3;
  int cells = 0;
  int occupied = 0;
  for (int iy = third; iy < seen.size - third; ++iy) {
    for (int ix = seen.size - third; ix < seen.size; ++ix) {
      ++cells;
      occupied += seen.occupancy[seen.index_of(ix, iy)] > 0.5F;
    }
  }
  return cells == 0 ? 0.0 : static_cast<double>(occupied) / cells;
}

bool is_blocked_ahead(const LocalOccupancy& seen, const ObstacleGuardParams& params) {
  return occupied_share_ahead(seen) > params.occupied_share;
}

}  // namespace cmn
