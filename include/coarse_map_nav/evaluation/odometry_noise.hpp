// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What wheel odometry would have said about a path that is known exactly.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/param_tree.hpp"

#include <cstdint>
#include <vector>

namespace cmn {

/// How odometry drifts. Defaults: a Kobuki on a hard floor, our estimate (2 % of the way, 1 degree
/// a quarter turn); no figure of a paper.
struct OdometryNoiseParams {
  double slip_m = 0.02;           ///< per root metre
  double turn_deg = 1.0;          ///< per root quarter turn
  double swerve_deg = 0.2;        ///< per root metre
  double wheel_bias = 0.01;       ///< wheel radius
  double wheelbase_bias = 0.005;  ///< distance of the wheels
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("slip_m", self.slip_m, Between{0.0, 1.0},
          "[m] error of the distance after one metre, 1 sigma");
    visit("turn_deg", self.turn_deg, Between{0.0, 45.0},
          "[deg] error of the heading after a turn by 90 deg, 1 sigma");
    visit("swerve_deg", self.swerve_deg, Between{0.0, 45.0},
          "[deg] error of the heading after one metre straight on, 1 sigma");
    visit("wheel_bias", self.wheel_bias, Between{0.0, 0.5},
          "[-] error of the wheel radius, constant over a run, 1 sigma");
    visit("wheelbase_bias", self.wheelbase_bias, Between{0.0, 0.5},
          "[-] error of the wheels' distance, constant over a run, 1 sigma");
  }
};

/// Odometry poses for the poses of a true path: same count, same order.
///
/// Each step is read as a turn, a straight way and another turn, and each of the three is
/// falsified, as in the odometry motion model of Thrun et al. 2005, Table 5.6. Two departures:
/// variances grow with the length of the motion, not with its square, so that a stretch drifts
/// equally much however finely it is sampled (alpha_1 = turn^2 / 90 deg, alpha_2 = swerve^2,
/// alpha_3 = slip^2, alpha_4 = 0); and the two constant biases of the base, the main error of a
/// real one (Borenstein and Feng 1996), are drawn once a run.
///
/// The odometry frame has its origin where the path begins, and its axes lie along those of the
/// path's frame: the discrete filter takes headings for axes of the building, as Robb's robot is
/// put down in line with the walls. Which axis is which stays unknown: the odometry starts with a
/// yaw in
/// [-pi/4, pi/4].
std::vector<Pose2> drifting_odometry(const std::vector<Pose2>& path,
                                     const OdometryNoiseParams& params, std::uint32_t seed);

}  // namespace cmn
