// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// All that a filter step needs to know of a cell, in nine bits.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace cmn {

/// A value for each of the 512 neighbourhoods a cell can have.
using NeighbourhoodTable = std::array<double, 512>;

/// The bit of the neighbour at offset (dx, dy), each in {-1, 0, 1}; (0, 0) is the cell itself.
constexpr unsigned neighbour_bit(Cell offset) {
  return 1U << static_cast<unsigned>((offset.y + 1) * 3 + offset.x + 1);
}

/// For every cell its 3 x 3 neighbourhood as a code: a set bit is an occupied neighbour.
///
/// Laid out like the layers of a Belief, border included, whose cells carry 511 (all occupied).
std::vector<std::uint16_t> neighbourhood_codes(const CoarseMap& map);

}  // namespace cmn
