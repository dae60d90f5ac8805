// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One look all around out of four, with quarter turns between them.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/perception/accumulator.hpp"

#include <cstddef>
#include <vector>

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
/// counts, of equals the last. Complete when four headings of the same axes have been looked at and
/// the robot faces the first of them again, so that a panorama has not turned it; from then on it
/// may turn on the spot and stays complete. A step away begins a new panorama. Looks are to be made
/// at rest.
class Panorama : public Accumulator {
 public:
  explicit Panorama(const PanoramaParams& params) : params_{params} {}

  LocalOccupancy fuse(LocalOccupancy look, const Pose2& T_odom_robot) override;
  void forget() override;
  bool is_complete() const override { return is_complete_; }

  /// Less than that is no step away, and no turn off a heading.
  static constexpr double kSpot_m = 0.05;
  static constexpr double kHeading_rad = 10.0 * kPi / 180.0;
  /// Four, and some from other axes: a robot starts out anywhere and turns onto its axes.
  static constexpr std::size_t kMostLooks = 8;

 private:
  struct Look {
    LocalOccupancy seen;
    Pose2 T_odom_robot;
  };
  bool has_four_and_faces_the_first(double yaw_rad) const;

  PanoramaParams params_;
  std::vector<Look> looks_;  ///< the last of each heading, in the order in which it was first seen
  Point2 spot_;
  bool is_complete_ = false;
};

}  // namespace cmn
