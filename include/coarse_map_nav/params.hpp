// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// All parameters of the package, in the order of the data flow. Presets in config/ set some of
/// them; docs/parameters.md is generated from here.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/localization/belief_filter.hpp"
#include "coarse_map_nav/motion/motion_controller.hpp"
#include "coarse_map_nav/perception/perception.hpp"
#include "coarse_map_nav/planning/planner.hpp"

namespace cmn {

struct NavigatorParams {
  PerceptionParams perception;
  LocalizationParams localization;
  PlanningParams planning;
  MotionParams motion;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit.group("perception", self.perception);
    visit.group("localization", self.localization);
    visit.group("planning", self.planning);
    visit.group("motion", self.motion);
  }
};

}  // namespace cmn
