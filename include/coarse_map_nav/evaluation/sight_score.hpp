// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How well what a robot sees around it agrees with what is there.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"
#include "coarse_map_nav/simulation/range_sensor.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <cstddef>

namespace cmn {

/// Intersection over union, summed up over many looks, of what was seen with what was in sight.
///
/// The truth is what a sensor without errors in the robot's middle would see all round, at all
/// heights of the robot: free ground up to the first obstacles, and these. Compared is a square of
/// 3.2 m about the robot (CMP's neighbourhood) in cells of 5 cm, and of it the cells in sight of
/// that sensor. An obstacle counts as the same where it is off by a cell at most.
class SightScore {
 public:
  /// `world`, of what stands in the robot's way, must outlive it.
  explicit SightScore(const World& world);

  /// `seen` about the robot, on any cells.
  void add(const LocalOccupancy& seen, const Pose2& T_world_robot);

  /// Of the ground that is free, seen to be so or both, the share that is both; NaN without any.
  double free_iou() const;
  /// Likewise of obstacles.
  double obstacle_iou() const;

 private:
  const World& world_;
  RangeSensor sensor_;
  RangeProjector projector_;
  std::size_t free_both_ = 0;
  std::size_t free_any_ = 0;
  std::size_t found_ = 0;   ///< obstacle cells of the truth that were seen
  std::size_t missed_ = 0;  ///< and those that were not
  std::size_t ghosts_ = 0;  ///< obstacle cells that were seen where none is
};

}  // namespace cmn
