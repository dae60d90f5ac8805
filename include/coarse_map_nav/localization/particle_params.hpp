// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Parameters of the particle filter.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"

namespace cmn {

/// Every default is ours; the papers give none.
struct ParticleParams {
  int count = 2000;
  double scale_spread = 0.2;
  double scale_noise = 0.1;
  double travel_noise = 0.1;
  double yaw_noise = 0.05;
  double renewed_share = 0.01;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("count", self.count, Between{10, 1000000}, "[particles]");
    visit("scale_spread", self.scale_spread, Between{0.0, 0.5},
          "[-] at the start the logarithm of a particle's scale is normal about 0 with this "
          "deviation");
    visit(
        "scale_noise", self.scale_noise, Between{0.0, 1.0},
        "[1/sqrt(m)] random walk of the scale, relative to it: the drawing is not stretched alike "
        "everywhere");
    visit("travel_noise", self.travel_noise, Between{0.0, 1.0},
          "[m/sqrt(m)] random walk of the position");
    visit("yaw_noise", self.yaw_noise, Between{0.0, 1.0},
          "[rad/sqrt(m)] random walk of the yaw; a quarter turn counts as a metre");
    visit("renewed_share", self.renewed_share, Between{0.0, 0.5},
          "[-] of the particles are put anywhere at each resampling, so that a wrong belief can be "
          "left again");
  }
};

}  // namespace cmn
