// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Draws in the measures of floor plans.
#pragma once

#include "coarse_map_nav/data/random.hpp"

#include <cmath>
#include <random>

namespace cmn {

/// The nearest multiple of 5 cm [m]: all coordinates of walls are.
inline double snapped(double metres) { return std::round(metres * 20.0) / 20.0; }
inline double draw_between(std::mt19937_64& rng, double low, double high) {
  return low + (high - low) * draw_uniform(rng);
}
inline double draw_snapped(std::mt19937_64& rng, double low, double high) {
  return snapped(draw_between(rng, low, high));
}
inline bool draw_chance(std::mt19937_64& rng, double p) { return draw_uniform(rng) < p; }

}  // namespace cmn
