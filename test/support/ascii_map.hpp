// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Maps that a reader of a test can see.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cmn {

/// '#' is occupied, everything else free; the first line is the top row, as it is seen.
inline CoarseMap ascii_map(const std::vector<std::string>& lines, double resolution = 1.0,
                           Pose2 T_map_grid = {}) {
  const auto height = static_cast<int>(lines.size());
  const auto width = static_cast<int>(lines.empty() ? 0 : lines.front().size());
  Grid<std::uint8_t> occupied{width, height};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      occupied({x, y}) =
          lines[static_cast<std::size_t>(height - 1 - y)][static_cast<std::size_t>(x)] == '#';
    }
  }
  return CoarseMap{std::move(occupied), resolution, T_map_grid};
}

/// The other way round, for a glance at what came out: '#' or '.', the top row first.
inline std::string ascii(const Grid<std::uint8_t>& occupied) {
  std::string text;
  for (int y = occupied.height(); y-- > 0;) {
    for (int x = 0; x < occupied.width(); ++x) {
      text += occupied({x, y}) != 0 ? '#' : '.';
    }
    text += '\n';
  }
  return text;
}

}  // namespace cmn
