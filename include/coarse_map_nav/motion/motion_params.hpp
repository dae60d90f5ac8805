// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How fast, how gently and how exactly the robot carries out an action.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"

namespace cmn {

/// Top speeds are Robb's for the Kobuki; the other defaults are ours, not from a paper.
struct MotionParams {
  double max_linear_mps = 0.3;
  double max_angular_radps = 1.0;
  double linear_acceleration = 0.5;
  double angular_acceleration = 1.5;
  double approach_gain = 4.0;
  double heading_gain = 2.0;
  double position_tolerance_m = 0.01;
  double yaw_tolerance_deg = 0.5;
  double odometry_timeout_s = 0.4;
  double action_timeout_s = 15.0;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("max_linear_mps", self.max_linear_mps, Between{0.01, 3.0}, "[m/s] top speed forward");
    visit("max_angular_radps", self.max_angular_radps, Between{0.05, 6.0},
          "[rad/s] top speed of a pivot");
    visit("linear_acceleration", self.linear_acceleration, Between{0.05, 5.0},
          "[m/s^2] ramp of the forward speed");
    visit("angular_acceleration", self.angular_acceleration, Between{0.05, 20.0},
          "[rad/s^2] ramp of the pivot speed");
    visit("approach_gain", self.approach_gain, Between{0.5, 50.0},
          "[1/s] speed per way left near the end of an action; lower for a base that answers late");
    visit("heading_gain", self.heading_gain, Between{0.0, 10.0},
          "[1/s] turn rate per radian off the axis while driving forward");
    visit("position_tolerance_m", self.position_tolerance_m, Between{0.001, 0.5},
          "[m] a forward step ends this close to its length");
    visit("yaw_tolerance_deg", self.yaw_tolerance_deg, Between{0.05, 20.0},
          "[deg] an action ends this close to the axis");
    visit("odometry_timeout_s", self.odometry_timeout_s, Between{0.05, 10.0},
          "[s] stop when odometry is silent for so long; noticed within 0.05 s more");
    visit("action_timeout_s", self.action_timeout_s, Between{0.5, 120.0},
          "[s] give an action up after so long");
  }
};

}  // namespace cmn
