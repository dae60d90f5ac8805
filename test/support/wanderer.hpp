// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A robot that walks about a flat: what a localizer sees there.
#pragma once

#include "coarse_map_nav/localization/localizer.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"
#include "coarse_map_nav/simulation/range_sensor.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <cstdint>

#include "ascii_map.hpp"
#include "random_case.hpp"

namespace cmn {

constexpr double kFlatCell_m = 0.5;

/// A flat in which hardly two places look alike, drawn in cells that measure `nominal_m`.
inline CoarseMap flat(double nominal_m = kFlatCell_m) {
  return ascii_map({"####################",  //
                    "#......#....#......#",  //
                    "#......#....#..##..#",  //
                    "#..#...#...........#",  //
                    "#..........####..###",  //
                    "#......#...#.......#",  //
                    "####.###...#..#....#",  //
                    "#......#...#.......#",  //
                    "#..##......#####..##",  //
                    "#......#...........#",  //
                    "#......#....#......#",  //
                    "####################"},
                   nominal_m);
}

/// A robot with a noisy LiDAR that bumps through the flat as it is built.
class Wanderer {
 public:
  explicit Wanderer(std::uint64_t seed)
      : rng_{seed}, sensor_{LidarParams{}, static_cast<std::uint32_t>(seed)} {
    be_put_elsewhere();
  }
  /// The odometry does not notice.
  void be_put_elsewhere() {
    std::mt19937 rng{static_cast<std::uint32_t>(rng_())};
    T_world_robot = world_.random_free_pose(0.25, rng).value();
  }
  void step() {
    const Pose2 before = T_world_robot;
    const Pose2 T_ahead = T_world_robot * Pose2{0.25, 0.0, 0.0};
    const bool is_free = world_.is_disc_free(T_ahead.position(), 0.2);
    if (is_free && draw_uniform(rng_) > 0.05) {
      T_world_robot = T_ahead;
    } else {
      turn_ = draw_uniform(rng_) < 0.2 ? -turn_ : turn_;
      T_world_robot = T_world_robot * Pose2{0.0, 0.0, turn_ * kPi / 2.0};
    }
    T_odom_robot = T_odom_robot * (inverse(before) * T_world_robot);
  }
  LocalOccupancy look() { return projector_.project(sensor_.measure(world_, T_world_robot, 0.0)); }
  Correction step_and_look(Localizer& filter) {
    step();
    return filter.update(look(), T_odom_robot);
  }
  /// In cells of the flat.
  Point2 position_cells() const { return (1.0 / kFlatCell_m) * T_world_robot.position(); }
  Heading heading() const { return nearest_heading(T_world_robot.yaw); }
  /// It says so, and is within a cell and at the right heading.
  bool is_found_by(const Localizer& filter) const {
    const Localization at = filter.localization();
    return at.is_converged && at.estimate.heading == heading() &&
           norm(at.position_cells - position_cells()) < 1.0;
  }

  Pose2 T_world_robot;
  Pose2 T_odom_robot;

 private:
  World world_{flat()};
  std::mt19937_64 rng_;
  RangeSensor sensor_;
  RangeProjector projector_{ProjectionParams{80, 8.0, 0.0}};
  int turn_ = 1;
};

}  // namespace cmn
