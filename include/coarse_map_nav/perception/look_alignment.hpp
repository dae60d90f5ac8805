// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where a look was taken from, by what was seen before and by odometry.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/param_tree.hpp"

#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// How much odometry is trusted against the looks.
struct AlignmentParams {
  bool enabled = true;
  double drift_per_turn_deg = 1.5;
  double drift_per_m_deg = 0.3;
  double slip_m = 0.01;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("enabled", self.enabled, Anything{},
          "lay each look where it fits what was seen before, not where odometry says");
    visit("drift_per_turn_deg", self.drift_per_turn_deg, Between{0.0, 45.0},
          "[deg] error of the odometry's heading in a quarter turn, one sigma");
    visit("drift_per_m_deg", self.drift_per_m_deg, Between{0.0, 45.0},
          "[deg] and in a metre driven");
    visit("slip_m", self.slip_m, Between{0.0, 1.0},
          "[m] error of the odometry's way in a metre driven, one sigma");
  }
};

/// The pose near `T_map_robot`, where the robot is by odometry since `T_map_last`, the pose of the
/// look before, that is likeliest by both: the maximum a posteriori by Gauss and Newton's method on
/// smoothed cells (as Hector SLAM, Kohlbrecher et al. 2011, eq. 7 to 12, matches scans), the
/// odometry's Gaussian for a prior.
///
/// `seen`: surface_of the look, in the robot's frame [m]; fewer than 20 points are left where
/// odometry lays them. `known`: 1 in the cells where such a surface was seen before, 0 elsewhere;
/// cell (0, 0) has its middle at `corner`, in cells of the map's frame, x along columns and y along
/// rows, `resolution` [m/cell].
Pose2 align_look(const std::vector<Point2>& seen, const cv::Mat1b& known, Point2 corner,
                 double resolution, const Pose2& T_map_robot, const Pose2& T_map_last,
                 const AlignmentParams& params);

}  // namespace cmn
