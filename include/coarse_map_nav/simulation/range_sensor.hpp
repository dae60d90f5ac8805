// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A planar LiDAR in a World.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace cmn {

/// About the RPLIDAR A2 of the LoCoBot. Defaults are plausible figures of ours, not from a paper.
struct LidarParams {
  int beams = 360;
  double field_of_view_deg = 360.0;
  double range_min_m = 0.15;
  double range_max_m = 10.0;
  double noise_m = 0.01;
  double noise_share = 0.005;
  double dropout = 0.01;
  std::string dropout_value = "inf";
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("beams", self.beams, Between{2, 10000}, "number of beams in a sweep");
    visit("field_of_view_deg", self.field_of_view_deg, Between{1.0, 360.0},
          "[deg] symmetric about the sensor's x axis");
    visit("range_min_m", self.range_min_m, Between{0.0, 5.0}, "[m] nearer things give no return");
    visit("range_max_m", self.range_max_m, Between{0.1, 200.0}, "[m] farther things give inf");
    visit("noise_m", self.noise_m, Between{0.0, 1.0}, "[m] gaussian error of a range");
    visit("noise_share", self.noise_share, Between{0.0, 0.5},
          "[-] gaussian error in proportion to the range, added to noise_m");
    visit("dropout", self.dropout, Between{0.0, 1.0}, "[-] probability that a beam is lost");
    visit("dropout_value", self.dropout_value, OneOf{{"inf", "nan"}},
          "what a lost or too short beam reads");
  }
};

/// Takes scans, each in one instant: the motion during a sweep is not simulated.
class RangeSensor {
 public:
  RangeSensor(const LidarParams& params, std::uint32_t seed, const Pose2& T_robot_sensor = {});

  RangeScan measure(const World& world, const Pose2& T_world_robot, double stamp_s);
  /// Unit vectors along the beams, in the sensor's frame.
  const std::vector<Point2>& directions() const { return directions_; }
  /// What the LiDAR makes of the true ranges along its beams; +inf: nothing there.
  RangeScan read(const std::vector<double>& true_ranges_m, const Pose2& T_robot_sensor,
                 double stamp_s);

 private:
  float read(double true_range_m);

  LidarParams params_;
  RangeScan layout_;                ///< a scan without ranges
  std::vector<Point2> directions_;  ///< of the beams, in the sensor's frame
  std::mt19937 rng_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
};

}  // namespace cmn
