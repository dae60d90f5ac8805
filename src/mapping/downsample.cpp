// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/downsample.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace cmn {
namespace {

constexpr double kRounding = 1e-6;  // of a ratio of resolutions such as 0.3 / 0.05

/// How fine cells [0, count) share out among coarse ones that are `ratio` of them wide.
template <class Add>
void share_out(int count, double ratio, Add&& add) {
  for (int fine = 0; fine < count; ++fine) {
    const int first = static_cast<int>(std::floor(fine / ratio + kRounding));
    // The border between `first` and its neighbour may cut the fine cell in two.
    const double border = (first + 1) * ratio;
    const double in_first = std::clamp(border - fine, 0.0, 1.0);
    add(fine, first, in_first);
    if (in_first < 1.0 - kRounding) {
      add(fine, first + 1, 1.0 - in_first);
    }
  }
}

}  // namespace

CoarseMap downsampled(const CoarseMap& world, double resolution) {
  const double ratio = resolution / world.resolution();
  if (!std::isfinite(ratio) || ratio < 1.0 - kRounding) {
    std::ostringstream text;
    text << "a map of " << world.resolution() << " m/cell cannot be made coarser to " << resolution
         << " m/cell";
    throw std::invalid_argument(text.str());
  }
  const int width = static_cast<int>(std::ceil(world.width() / ratio - kRounding));
  const int height = static_cast<int>(std::ceil(world.height() / ratio - kRounding));
  // Free area in fine cells, first along the rows, then along the columns.
  Grid<double> free_in_row{width, world.height()};
  share_out(world.width(), ratio, [&](int x, int coarse_x, double share) {
    for (int y = 0; y < world.height(); ++y) {
      free_in_row({coarse_x, y}) += world.is_free({x, y}) ? share : 0.0;
    }
  });
  Grid<double> free_area{width, height};
  share_out(world.height(), ratio, [&](int y, int coarse_y, double share) {
    for (int x = 0; x < width; ++x) {
      free_area({x, coarse_y}) += share * free_in_row({x, y});
    }
  });
  Grid<std::uint8_t> occupied{width, height};
  const double half = 0.5 * ratio * ratio;
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    occupied[i] = free_area[i] < half * (1.0 - kRounding) ? 1 : 0;
  }
  return {std::move(occupied), resolution, world.T_map_grid()};
}

}  // namespace cmn
