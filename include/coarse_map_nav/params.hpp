// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// All parameters of the package, in the order of the data flow. Presets in config/ set some of
/// them; docs/parameters.md is generated from here.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/localization/belief_filter.hpp"
#include "coarse_map_nav/motion/motion_controller.hpp"
#include "coarse_map_nav/perception/obstacle_guard.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"
#include "coarse_map_nav/perception/rolling_map.hpp"
#include "coarse_map_nav/planning/planner.hpp"

namespace cmn {

struct PerceptionParams {
  std::string source = "lidar";
  std::string accumulate = "none";
  RollingMapParams rolling;
  ProjectionParams local_occupancy;
  ProjectionParams local_map{160, 8.0, 0.0};
  ObstacleGuardParams guard;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("source", self.source, OneOf{{"lidar"}}, "the sensor that local occupancy is made from");
    visit("accumulate", self.accumulate, OneOf{{"none", "rolling"}},
          "none: each look by itself; rolling: what was seen lately is kept (CMP eq. 1 to 3)");
    visit.group("rolling", self.rolling);
    visit.group("local_occupancy", self.local_occupancy);
    visit.group("local_map", self.local_map);
    visit.group("guard", self.guard);
  }
};

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
