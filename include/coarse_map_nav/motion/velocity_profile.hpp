// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Speeds that ramp up, hold and ramp down to a stop at a chosen place.
#pragma once

namespace cmn {

/// What a profile along a line (metres) or around the robot (radians) keeps to.
struct SpeedLimits {
  double max_speed = 0.0;      ///< [unit/s]
  double acceleration = 0.0;   ///< [unit/s^2], up as well as down
  double approach_gain = 0.0;  ///< [1/s]
};

/// The greatest speed from which the way left suffices to stop; the sign is that of `way_left`.
///
/// Braking is planned at a share of the acceleration limit, so that a command that follows late by
/// a period or a base that answers late does not overshoot. Over the last acceleration / gain^2 the
/// speed is proportional to the way left: the square root alone has an infinite slope at its end,
/// which no base can follow. Together with ramped() this is Robb's ramp ("Better Pivot Controller":
/// up over the first half, down over the second): a triangle for a short way, a trapezoid for one
/// long enough to reach the top speed.
double approach_speed(double way_left, const SpeedLimits& limits);

/// The speed nearest to `wanted` that the acceleration limit lets one reach from `current`.
double ramped(double current, double wanted, double acceleration, double period_s);

}  // namespace cmn
