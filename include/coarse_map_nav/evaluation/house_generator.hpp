// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Furnished homes without end, each from a seed.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/evaluation/house.hpp"

#include <cstdint>

namespace cmn {

/// What kind of homes. The scale is that of the houses in Gibson (Xia et al. 2018) that CMN uses.
struct HouseParams {
  double smallest_m2 = 40.0;
  double largest_m2 = 150.0;
  double narrowest_door_m = 0.7;
  double widest_door_m = 0.9;
  double outer_wall_m = 0.2;
  double inner_wall_m = 0.1;
  double way_m = 0.54;
  double clutter = 0.7;

  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("smallest_m2", self.smallest_m2, Between{40.0, 150.0}, "[m2] floor, wall to wall");
    visit("largest_m2", self.largest_m2, Between{40.0, 150.0}, "[m2] floor, wall to wall");
    visit("narrowest_door_m", self.narrowest_door_m, Between{0.6, 1.2}, "[m] clear width");
    visit("widest_door_m", self.widest_door_m, Between{0.6, 1.2}, "[m] clear width");
    visit("outer_wall_m", self.outer_wall_m, Between{0.1, 0.5}, "[m] thickness");
    visit("inner_wall_m", self.inner_wall_m, Between{0.1, 0.2}, "[m] thickness");
    visit("way_m", self.way_m, Between{0.4, 1.0},
          "[m] furniture leaves ways of this width from door to door");
    visit("clutter", self.clutter, Between{0.0, 1.0},
          "[-] share of the pieces that a home could do without");
  }
};

/// A home: a hall with rooms around it, each with a purpose and the furniture for it. All rooms can
/// be reached from each other by a robot of 0.18 m radius. The same seed gives the same house
/// everywhere. Throws std::invalid_argument when parameters contradict each other.
House generate_house(std::uint32_t seed, const HouseParams& params = {});

}  // namespace cmn
