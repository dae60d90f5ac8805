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
  double gain = 0.2;
  double turn_share = 0.0;
  double look_sigma_deg = 2.0;
  double least_peak = 1.15;
  double bin_m = 0.1;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("enabled", self.enabled, Anything{},
          "take the axes of the drawing from the walls that are seen, not from the odometry alone");
    visit("gain", self.gain, Between{0.0, 1.0},
          "[-] share of a new direction that is believed on a straight way");
    visit("turn_share", self.turn_share, Between{0.0, 1.0},
          "[-] how much of a turn the odometry loses or adds, 1 sigma: after it the walls that are "
          "seen count more; 0: a good gyroscope");
    visit("look_sigma_deg", self.look_sigma_deg, Between{0.1, 20.0},
          "[deg] standard deviation of the direction that one look shows");
    visit("least_peak", self.least_peak, Between{1.0, 10.0},
          "[-] how much sharper than on average walls must show up in a direction to count");
    visit("bin_m", self.bin_m, Between{0.02, 1.0},
          "[m] width of the strips that hits are counted in");
  }
};

/// Odometry's heading drifts without bound; the walls of a building do not. Where most walls stand
/// at right angles, counting what is seen in strips along and across a direction gives the sharpest
/// counts along the walls (ours).
///
/// Follows that direction from look to look, starting from the odometry's own axes (Robb: the robot
/// is set down along the walls), so it never takes a jump of a quarter turn. In round halls and
/// outside no direction is sharp enough, and the odometry is followed as it is.
///
/// How much a look counts is a Kalman filter's gain. On a straight way it is `gain`; a turn in
/// which the odometry may have lost `turn_share` of it raises it, and widens what is sought, till
/// the walls have been seen again.
class WallCompass {
 public:
  explicit WallCompass(const WallCompassParams& params) : params_{params}, variance_{params.gain} {}

  /// `yaw_rad` of the grid's x axis in the frame of the odometry.
  void look(const LocalOccupancy& seen, double yaw_rad);
  /// Yaw of the building's axes in the frame of the odometry; begins with 0 [rad].
  double axes_yaw_rad() const { return axes_yaw_rad_; }

 private:
  double sharpness(const std::vector<Point2>& hits, double yaw_rad);

  WallCompassParams params_;
  double axes_yaw_rad_ = 0.0;
  double variance_ = 0.0;  ///< of axes_yaw_rad_, in those of one look
  std::optional<double> last_yaw_rad_;
  std::vector<int> counts_;
};

}  // namespace cmn
