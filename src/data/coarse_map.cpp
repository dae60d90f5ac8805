// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/data/coarse_map.hpp"

namespace cmn {

CoarseMap cut(const CoarseMap& map, int cuts) {
  Grid<std::uint8_t> occupied{map.width() * cuts, map.height() * cuts};
  for (int y = 0; y < occupied.height(); ++y) {
    for (int x = 0; x < occupied.width(); ++x) {
      occupied({x, y}) = map.occupied()({x / cuts, y / cuts});
    }
  }
  return {std::move(occupied), map.resolution() / cuts, map.T_map_grid()};
}

}  // namespace cmn
