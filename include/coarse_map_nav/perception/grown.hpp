// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What is seen -> where the middle of a robot could be.
#pragma once

#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

namespace cmn {

/// The square that a look must be on for grown() to know all that reaches into `grid`: with a
/// margin of `by_m` on each side.
ProjectionParams with_margin(const ProjectionParams& grid, double by_m);

/// The middle `size` x `size` cells of a look in which everything that was seen to be occupied is
/// larger by `by_m` all round: seen to be occupied, too. `size` is no larger than the look's and
/// differs from it by an even number.
///
/// What stands nearer than that to the robot's middle grows only as far as there: where the robot
/// is, its middle can be. Surfaces are taken to lie half a cell before the middles of their cells.
LocalOccupancy grown(LocalOccupancy seen, double by_m, int size);

}  // namespace cmn
