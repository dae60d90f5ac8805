// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a network predicts -> the scan of a LiDAR that would have seen the same.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/perception/occupancy_predictor.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

#include <string>

namespace cmn {

struct RgbParams {
  std::string model;
  double most_spread_m = 0.5;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("model", self.model, Anything{},
          "rgb: file of the network (TorchScript), see seeing-in-colour.md");
    visit("most_spread_m", self.most_spread_m, Between{0.01, 5.0},
          "[m] rgb: an obstacle whose range the network knows no better (10 to 90 %) is none, and "
          "the ground before it is all that was seen");
  }
};

/// The ranges that a prediction comes to, a beam a degree from the robot's middle, all around.
///
/// That a cell is free and in sight has the probability P(in sight) (1 - P(occupied)), and along a
/// ray that is the chance that the obstacle lies beyond: one minus the distribution of its range.
/// The median is the measured range where 10 and 90 % lie near enough to each other; otherwise the
/// ground is free (RangeScan::Sight) up to the 10 % and nothing is known beyond. The near square
/// counts where it reaches, around it the wide one. Of a bearing that `panorama`, from which it was
/// predicted, does not show, or that is not free from the beginning, nothing is known: NaN.
RangeScan predicted_scan(const PredictedOccupancy& predicted, const ColorPanorama& panorama,
                         const RgbParams& params);

}  // namespace cmn
