// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One look all around out of four, with quarter turns between them.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/perception/accumulator.hpp"
#include "coarse_map_nav/perception/looks_around.hpp"

namespace cmn {

struct PanoramaParams {
  double corner_share = 1.0;
  double corner_side_m = 1.28;  ///< CMN: of the local occupancy
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("corner_share", self.corner_share, Between{0.0, 1.0},
          "[-] panorama: a corner block of which more is occupied becomes occupied as a whole "
          "(Robb: mostly, 0.5); 1: never");
    visit("corner_side_m", self.corner_side_m, Between{0.3, 50.0},
          "[m] panorama: of the square about the robot whose four corner blocks are meant, a third "
          "of it wide");
  }
};

/// Robb's corner filling: four looks of less than 90 deg leave wedges at the corners unseen.
void fill_corners(LocalOccupancy& seen, const PanoramaParams& params);

/// The panorama of CMN and Robb: looks at four headings, a quarter turn apart, from one spot.
///
/// They are laid over each other by odometry; where two of them saw a cell, the more confident one
/// counts, of equals the last. When it is complete says LooksAround.
class Panorama : public Accumulator {
 public:
  explicit Panorama(const PanoramaParams& params) : params_{params} {}

  LocalOccupancy fuse(LocalOccupancy look, const Pose2& T_odom_robot) override;
  void forget() override { around_.forget(); }
  bool is_complete() const override { return around_.is_complete(); }

 private:
  PanoramaParams params_;
  LooksAround<LocalOccupancy> around_;
};

}  // namespace cmn
