// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Which way the walls run, in the frame of the odometry.
#pragma once

#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/param_tree.hpp"

#include <optional>
#include <vector>

namespace cmn {

struct WallCompassParams {
  bool enabled = true;
  double start_sigma_deg = 2.0;
  double lost_sigma_deg = 15.0;
  double look_sigma_deg = 4.0;
  double drift_per_turn_deg = 1.0;
  double drift_per_m_deg = 0.3;
  double drift_per_look_deg = 0.0;
  double drift_aligned_deg = 0.3;
  double least_peak = 1.2;
  double bin_m = 0.1;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("enabled", self.enabled, Anything{},
          "take the axes of the drawing from the walls that are seen, not from the odometry alone");
    visit("start_sigma_deg", self.start_sigma_deg, Between{0.01, 45.0},
          "[deg] how far from the odometry's axes the walls may run at the start, one sigma");
    visit("lost_sigma_deg", self.lost_sigma_deg, Between{0.01, 45.0},
          "[deg] and how far from what was believed when the belief is re-opened");
    visit("look_sigma_deg", self.look_sigma_deg, Between{0.01, 45.0},
          "[deg] error of the direction that a look gives whose walls show up just so sharply as "
          "least_peak, one sigma; less in proportion to what is above 1");
    visit("drift_per_turn_deg", self.drift_per_turn_deg, Between{0.0, 45.0},
          "[deg] drift of the odometry's heading in a quarter turn, one sigma");
    visit("drift_per_m_deg", self.drift_per_m_deg, Between{0.0, 45.0},
          "[deg] and in a metre driven");
    visit("drift_per_look_deg", self.drift_per_look_deg, Between{0.0, 45.0},
          "[deg] and from look to look in turns that end where they began and are not told of, as "
          "the four of a panorama");
    visit("drift_aligned_deg", self.drift_aligned_deg, Between{0.0, 45.0},
          "[deg] in place of these three from look to look where perception aligns them and tells "
          "what odometry has drifted, one sigma");
    visit("least_peak", self.least_peak, Between{1.01, 10.0},
          "[-] how much sharper than on average walls must show up in a direction to count");
    visit("bin_m", self.bin_m, Between{0.02, 1.0},
          "[m] width of the strips that hits are counted in");
  }
};

/// Odometry's heading drifts without bound; the walls of a building do not. Where most walls stand
/// at right angles, counting what is seen in strips along and across a direction gives the sharpest
/// counts along the walls (ours).
///
/// Follows that direction from look to look by a Kalman filter with a gate, by what odometry has
/// drifted in between where perception knows that (HeadingDrift), starting from the
/// odometry's own axes (Robb: the robot is set down along the walls), so it never takes a jump of a
/// quarter turn, nor a piece of furniture that stands askew for a wall. In round halls and outside
/// no direction is sharp enough, and the odometry is followed as it is.
class WallCompass {
 public:
  explicit WallCompass(const WallCompassParams& params)
      : params_{params}, sigma_deg_{params.start_sigma_deg} {}

  void look(const LocalOccupancy& seen, const Pose2& T_odom_robot);
  /// The robot may have been turned by any angle.
  void lose();
  /// Yaw of the building's axes in the frame of the odometry; begins with 0 [rad].
  double axes_yaw_rad() const { return axes_yaw_rad_; }

 private:
  double sharpness(const std::vector<Point2>& hits, double yaw_rad);

  WallCompassParams params_;
  double axes_yaw_rad_ = 0.0;
  double sigma_deg_;  ///< of axes_yaw_rad_
  std::optional<Pose2> T_odom_last_;
  std::optional<HeadingDrift> drift_last_;  ///< that perception told of
  std::vector<int> counts_;
};

}  // namespace cmn
