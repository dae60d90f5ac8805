// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What it is worth to learn where the robot is.
#pragma once

#include "coarse_map_nav/data/expected_looks.hpp"
#include "coarse_map_nav/planning/local_lattice.hpp"

#include <cstddef>
#include <vector>

namespace cmn {

/// Where the robot may be.
struct Hypothesis {
  GridPose pose;
  double weight = 0.0;
};

/// The likeliest hypotheses that are more than `apart_cells` from each other or face another way,
/// at most so many and the likeliest first, each with the weight of all that is near it.
std::vector<Hypothesis> distinct(std::vector<Hypothesis> hypotheses, double apart_cells,
                                 std::size_t most);

/// What is asked: the places that the robot can drive to, and what each would mean.
struct Prospects {
  const LocalLattice& lattice;
  const std::vector<Hypothesis>& hypotheses;
  /// [hypothesis][place] what a place costs, all told, where that hypothesis is true [m]
  const std::vector<std::vector<double>>& costs_m;
  /// [place] 0: the robot was there and sees nothing new, 1: all is new
  const std::vector<double>& newness;
  double cells_per_m;
  double scale;  ///< drawn metres a metre
};

/// Of each place of the lattice, what the looks on the way there are expected to save [m]: the
/// value of information.
///
/// A robot that takes itself to be where j says while it is where i says goes to j's best place,
/// which costs more for i than i's own. So it loses, as often as it believes j where i is true,
/// P(i) P(j), unless it is told them apart on the way: 1 - exp(-expected log likelihood ratio).
/// Only what looks tell there beyond what they tell here counts: both have outlived this one.
std::vector<double> savings_m(const Prospects& prospects, const ExpectedLooks& looks);

}  // namespace cmn
