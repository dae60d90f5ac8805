// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/neighbourhood.hpp"

#include "coarse_map_nav/data/belief.hpp"

#include <array>

namespace cmn {

std::vector<std::uint16_t> neighbourhood_codes(const CoarseMap& map) {
  const Belief layout{map.width(), map.height()};
  std::vector<std::uint16_t> codes(layout.padded_size(), 511);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      unsigned code = 0;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          code |= map.is_occupied({x + dx, y + dy}) ? neighbour_bit({dx, dy}) : 0U;
        }
      }
      codes[layout.padded_index({x, y})] = static_cast<std::uint16_t>(code);
    }
  }
  return codes;
}

NeighbourhoodKinds::NeighbourhoodKinds(const CoarseMap& map)
    : codes{511}, of_cell{neighbourhood_codes(map)} {
  std::array<std::uint16_t, kNeighbourhoods> kind_of_code{};
  for (std::uint16_t& cell : of_cell) {
    const std::uint16_t code = cell;
    const bool is_free = (code & neighbour_bit({0, 0})) == 0;
    if (is_free && kind_of_code[code] == 0) {
      kind_of_code[code] = static_cast<std::uint16_t>(codes.size());
      codes.push_back(code);
    }
    cell = kind_of_code[code];
  }
}

}  // namespace cmn
