// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/given_pose.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace cmn {

void GivenPose::place(const Pose2& T_map_robot) {
  belief_.set_weight(estimate_.heading, estimate_.cell, 0.0);
  const Point2 p = inverse(map_.T_map_grid()) * T_map_robot.position();
  position_cells_ = (1.0 / map_.resolution()) * p;
  yaw_rad_ = wrap_angle(T_map_robot.yaw - map_.T_map_grid().yaw);
  estimate_ = {nearest_heading(yaw_rad_), nearest_free(map_.cell_of(T_map_robot.position())), 1.0};
  belief_.set_weight(estimate_.heading, estimate_.cell, 1.0);
  belief_.set_factor(1.0);
}

Cell GivenPose::nearest_free(Cell c) const {
  const int farthest = map_.width() + map_.height() + std::abs(c.x) + std::abs(c.y);
  Cell nearest = c;
  int least = std::numeric_limits<int>::max();
  // Rings of growing size; one more than the first with a free cell may hold a nearer one.
  for (int ring = 0; ring <= farthest && ring * ring < least; ++ring) {
    for (int dy = -ring; dy <= ring; ++dy) {
      const bool is_edge = std::abs(dy) == ring;
      for (int dx = -ring; dx <= ring; dx += is_edge || ring == 0 ? 1 : 2 * ring) {
        if (dx * dx + dy * dy < least && map_.is_free(c + Cell{dx, dy})) {
          least = dx * dx + dy * dy;
          nearest = c + Cell{dx, dy};
        }
      }
    }
  }
  return nearest;
}

}  // namespace cmn
