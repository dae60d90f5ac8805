// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A metric map -> the coarse grid of the CMN paper's experiments.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"

namespace cmn {

/// The same area and pose at a coarser resolution [m/cell]: a cell is occupied when more than half
/// of its area is (design of the CMN evaluation, "coarse-grid"). Any ratio of resolutions: border
/// cells count by the part of them that is covered, and what lies outside `world` is occupied.
/// Cost: one pass over `world`. Throws std::invalid_argument unless `resolution` is finite and at
/// least that of `world`.
CoarseMap downsampled(const CoarseMap& world, double resolution);

}  // namespace cmn
