// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// All that a filter step needs to know of a cell, in nine bits.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cmn {

constexpr std::size_t kNeighbourhoods = 512;

/// The bit of the neighbour at offset (dx, dy), each in {-1, 0, 1}; (0, 0) is the cell itself.
constexpr unsigned neighbour_bit(Cell offset) {
  return 1U << static_cast<unsigned>((offset.y + 1) * 3 + offset.x + 1);
}

/// For every cell its 3 x 3 neighbourhood as a code: a set bit is an occupied neighbour.
///
/// Laid out like the layers of a Belief, border included, whose cells carry 511 (all occupied).
std::vector<std::uint16_t> neighbourhood_codes(const CoarseMap& map);

/// The different neighbourhoods that the free cells of a map have: fewer than 257, often some
/// dozens, so that tables over them are quickly filled.
///
/// Kind 0 stands for all occupied cells; its code is 511.
struct NeighbourhoodKinds {
  explicit NeighbourhoodKinds(const CoarseMap& map);
  std::vector<std::uint16_t> codes;    ///< of each kind
  std::vector<std::uint16_t> of_cell;  ///< the kind of each cell, laid out like the codes
};

}  // namespace cmn
