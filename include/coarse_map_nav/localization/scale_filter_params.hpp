// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Parameters of ScaleFilter.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/localization/wall_compass.hpp"

namespace cmn {

struct ScaleFilterParams {
  WallCompassParams compass;
  double reach_m = 8.0;
  double part_m = 0.2;
  double most_parts = 6000;
  int headings = 4;
  int scales = 5;
  double least_scale = 0.7;
  double greatest_scale = 1.4;
  double scale_sigma = 0.25;
  double range_weight = 8.0;
  double range_sigma = 0.14;
  double range_short = 0.25;
  double range_random = 0.08;
  double field_weight = 1.5;
  double field_sigma_m = 0.3;
  double field_random = 0.3;
  double free_weight = 4.0;
  double independence_m = 1.0;
  double rim_penalty = 0.3;
  double diffusion = 0.1;
  double blocked_share = 0.3;
  double reopen_fit = -0.8;
  double reopen_way_m = 2.0;
  double reopen_share = 0.3;
  double carried_share = 0.2;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit.group("compass", self.compass);
    visit("reach_m", self.reach_m, Between{0.5, 100.0}, "[m] rays are compared up to this range");
    visit("part_m", self.part_m, Between{0.01, 10.0},
          "[m] hypotheses lie no farther apart: cells of the drawing are cut so finely");
    visit("most_parts", self.most_parts, Between{1.0, 1e9},
          "but into no more parts of free ground than that, in all: larger maps are cut less");
    visit("headings", self.headings, MultipleOf{4, 360},
          "in how many directions, evenly spaced, the drawing may lie to the axes that the robot "
          "keeps to; 4: as the walls do");
    visit("scales", self.scales, Between{1, 32},
          "how many scales of the drawing are believed in, evenly spaced in log; 1: the nominal");
    visit("least_scale", self.least_scale, Between{0.1, 10.0},
          "[-] drawn metres a metre, at least");
    visit("greatest_scale", self.greatest_scale, Between{0.1, 10.0}, "[-] and at most");
    visit("scale_sigma", self.scale_sigma, Between{0.01, 100.0},
          "[-] standard deviation, of the log of the scale before the first look; its mean is 0, "
          "the nominal scale");
    visit("range_weight", self.range_weight, Between{0.0, 200.0},
          "[-] range model: the mean over the bearings counts as so many independent ranges");
    visit("range_sigma", self.range_sigma, Between{0.01, 2.0},
          "[-] range model: standard deviation of the log of seen over expected range");
    visit("range_short", self.range_short, Between{0.0, 1.0},
          "[-] range model: share of a perfect match that a range shorter than expected is worth");
    visit("range_random", self.range_random, Between{1e-6, 1.0},
          "[-] range model: likewise of any range whatever");
    visit("field_weight", self.field_weight, Between{0.0, 200.0},
          "[-] likelihood field: the mean over the hits counts as so many independent ones");
    visit("field_sigma_m", self.field_sigma_m, Between{0.01, 5.0},
          "[m] likelihood field: standard deviation of the distance to what is drawn");
    visit("field_random", self.field_random, Between{1e-6, 1.0},
          "[-] likelihood field: floor of a hit far from everything drawn");
    visit("free_weight", self.free_weight, Between{0.0, 200.0},
          "[-] price of a look whose free rays lie all on what is drawn as occupied");
    visit("independence_m", self.independence_m, Between{0.01, 10.0},
          "[m] looks so far apart are independent, nearer ones count in proportion");
    visit("rim_penalty", self.rim_penalty, Between{0.0, 1.0},
          "[-] likelihood of standing on an occupied cell beside a free one, per look");
    visit("diffusion", self.diffusion, Between{0.0, 5.0},
          "[1/m] share of a cell's belief that goes over to each neighbour per metre driven");
    visit(
        "reopen_fit", self.reopen_fit, Between{-20.0, 1.0},
        "[nats] the belief is re-opened when the rays fit worse than this at the best hypothesis, "
        "on the mean of the last looks");
    visit("reopen_way_m", self.reopen_way_m, Between{0.05, 100.0},
          "[m] the way over which that mean is taken");
    visit("reopen_share", self.reopen_share, Between{0.0, 1.0},
          "[-] share of a uniform belief mixed in then");
    visit("carried_share", self.carried_share, Between{0.0, 1.0},
          "[-] the belief starts over when so much of what stands in a look is amid what the last "
          "saw to be free, and the other way round: the robot was carried; 1: never");
    visit("blocked_share", self.blocked_share, Between{0.0, 1.0},
          "[-] so much of the belief that would have to pass a drawn wall stays before it");
  }
};

}  // namespace cmn
