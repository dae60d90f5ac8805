// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How looks of depth cameras are read, and what became of one.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/perception/floor_plane.hpp"

#include <cstddef>

namespace cmn {

struct DepthParams {
  double increment_deg = 0.5;
  double range_min_m = 0.1;
  double range_max_m = 5.0;  ///< RealSense: noise grows with the square of the depth
  double lowest_m = 0.06;
  double highest_m = 0.8;  ///< the LoCoBot's 0.6 m, and tables
  double least_share = 0.004;
  FloorParams floor;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("increment_deg", self.increment_deg, Between{0.1, 5.0},
          "[deg] depth: between the bearings of the scan it becomes; at least the camera's pixels");
    visit("range_min_m", self.range_min_m, Between{0.01, 2.0}, "[m] depth: nearer points are none");
    visit("range_max_m", self.range_max_m, Between{0.5, 20.0},
          "[m] depth: farther ones only say that it is free so far");
    visit("lowest_m", self.lowest_m, Between{0.01, 0.5},
          "[m] depth: what rises less over the floor is floor");
    visit("highest_m", self.highest_m, Between{0.1, 3.0},
          "[m] depth: what is higher over the floor is not in the way");
    visit("least_share", self.least_share, Between{0.0, 0.2},
          "[-] depth: points that have fewer around them, of those of their bearing, are noise");
    visit.group("floor", self.floor);
  }
};

/// What became of the points of one look.
struct DepthReport {
  std::size_t points = 0;    ///< with a reading
  std::size_t unusable = 0;  ///< NaN, inf, 0, negative or too near
  std::size_t flying = 0;    ///< between two surfaces, on neither
  std::size_t isolated = 0;  ///< in the way, but alone there
  FloorSource floor = FloorSource::kNominal;
  FloorPlane plane;
};

}  // namespace cmn
