// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/obstacle_guard.hpp"

#include <algorithm>
#include <cmath>

namespace cmn {

double occupied_share_ahead(const LocalOccupancy& seen, double side_m) {
  const double half = 0.5 * std::min(side_m / seen.resolution, static_cast<double>(seen.size));
  const auto cell_at = [&](double from_middle) {
    return static_cast<int>(std::lround(0.5 * seen.size + from_middle));
  };
  int cells = 0;
  int occupied = 0;
  for (int iy = cell_at(-half / 3.0); iy < cell_at(half / 3.0); ++iy) {
    for (int ix = cell_at(half / 3.0); ix < cell_at(half); ++ix) {
      ++cells;
      occupied += seen.occupancy[seen.index_of(ix, iy)] > 0.5F;
    }
  }
  return cells == 0 ? 0.0 : static_cast<double>(occupied) / cells;
}

bool is_blocked_ahead(const LocalOccupancy& seen, const ObstacleGuardParams& params) {
  return occupied_share_ahead(seen, params.side_m) > params.occupied_share;
}

void GuardMemory::remember(double stamp_s, bool is_blocked) {
  // What is of a later time was seen before time went back.
  blocked_at_.erase(blocked_at_.upper_bound(stamp_s), blocked_at_.end());
  blocked_at_[stamp_s] = is_blocked;
  if (blocked_at_.size() > kObservations) {
    blocked_at_.erase(blocked_at_.begin());
  }
}

bool GuardMemory::was_blocked(double stamp_s) const {
  const auto found = blocked_at_.find(stamp_s);
  return found == blocked_at_.end() || found->second;
}

}  // namespace cmn
