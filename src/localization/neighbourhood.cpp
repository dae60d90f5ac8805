// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/neighbourhood.hpp"

#include "coarse_map_nav/data/belief.hpp"

#include <string>
#include <unordered_map>

namespace cmn {
namespace {

/// The bits of the window about a cell, `kPieceBits` a letter.
std::u16string window_about(const CoarseMap& map, Cell c, int reach) {
  std::u16string pieces;
  unsigned piece = 0;
  int bits = 0;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      piece |= (map.is_occupied(c + Cell{dx, dy}) ? 1U : 0U) << static_cast<unsigned>(bits);
      if (++bits == kPieceBits) {
        pieces += static_cast<char16_t>(piece);
        piece = 0;
        bits = 0;
      }
    }
  }
  if (bits > 0) {
    pieces += static_cast<char16_t>(piece);
  }
  return pieces;
}

}  // namespace

WindowKinds::WindowKinds(const CoarseMap& map, int reach)
    : pieces{(static_cast<std::size_t>((2 * reach + 1) * (2 * reach + 1)) + kPieceBits - 1) /
             kPieceBits},
      codes(pieces, 0),
      neighbourhoods{511} {
  const Belief layout{map.width(), map.height()};
  of_cell.assign(layout.padded_size(), 0);
  std::unordered_map<std::u16string, std::uint32_t> kinds;
  for (std::size_t i = 0; i < map.occupied().size(); ++i) {
    const Cell c = map.occupied().cell_at(i);
    if (map.is_occupied(c)) {
      continue;
    }
    if (map.is_free(c - Cell{1, 0})) {
      ++runs.back().count;
    } else {
      runs.push_back({c, 1});
    }
    const std::u16string window = window_about(map, c, reach);
    const std::u16string neighbourhood = window_about(map, c, 1);
    const auto [kind, is_new] =
        kinds.emplace(window + neighbourhood, static_cast<std::uint32_t>(size()));
    if (is_new) {
      codes.insert(codes.end(), window.begin(), window.end());
      neighbourhoods.push_back(neighbourhood[0]);
    }
    of_cell[layout.padded_index(c)] = kind->second;
  }
}

}  // namespace cmn
