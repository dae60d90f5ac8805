// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Draws that are the same with every standard library: the engine is specified, the distributions
/// of C++'s random header are not.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <random>

namespace cmn {

/// Uniform on [0, 1).
inline double draw_uniform(std::mt19937_64& rng) {
  return static_cast<double>(rng() >> 11U) * 0x1.0p-53;
}
/// Uniform on {0 .. count - 1}; count > 0.
inline std::size_t draw_index(std::mt19937_64& rng, std::size_t count) {
  return static_cast<std::size_t>(draw_uniform(rng) * static_cast<double>(count));
}
/// Normal with mean 0 and standard deviation 1 (Box and Muller 1958; two draws each).
inline double draw_normal(std::mt19937_64& rng) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - draw_uniform(rng)));
  return radius * std::cos(2.0 * kPi * draw_uniform(rng));
}
/// Two such numbers, independent of each other, for the price of one.
inline std::array<double, 2> draw_two_normals(std::mt19937_64& rng) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - draw_uniform(rng)));
  const double angle = 2.0 * kPi * draw_uniform(rng);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace cmn
