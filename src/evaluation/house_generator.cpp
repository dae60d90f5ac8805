// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/house_generator.hpp"

#include "coarse_map_nav/evaluation/floor_plan.hpp"
#include "coarse_map_nav/evaluation/furnishing.hpp"

#include <random>
#include <stdexcept>

namespace cmn {

House generate_house(std::uint32_t seed, const HouseParams& params) {
  if (params.smallest_m2 > params.largest_m2) {
    throw std::invalid_argument("smallest_m2 is above largest_m2");
  }
  if (params.narrowest_door_m > params.widest_door_m) {
    throw std::invalid_argument("narrowest_door_m is above widest_door_m");
  }
  std::mt19937_64 rng{seed};
  House house = draw_floor_plan(rng, params);
  furnish(house, rng, params);
  return house;
}

}  // namespace cmn
