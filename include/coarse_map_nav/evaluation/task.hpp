// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The tasks of the evaluation: what the robot is given and what it sees.
#pragma once

#include "coarse_map_nav/evaluation/drawing.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cmn {

enum class DrawingKind { kCoarseGrid, kHandDrawn, kWallsOnly, kTurnedGrid };
/// Of kTurnedGrid: how far its axes lie from those of the walls.
constexpr double kDrawingTurn_rad = 7.0 * kPi / 180.0;
enum class ObservationKind {
  kTrueCrop,       ///< the true 3 x 3 crop of the map (CMN, "grid observations")
  kLidar,          ///< 360 deg; and the depth camera, where a method's preset looks with it
  kForward,        ///< likewise, but the LiDAR looks forward, too: 180 deg
  kDepthPanorama,  ///< four looks of the depth camera with pivots, whatever the preset
  kColorPanorama   ///< four looks of the colour camera with pivots, predicted from; likewise
};

struct Task {
  std::string name;
  DrawingKind drawing = DrawingKind::kCoarseGrid;
  ObservationKind observation = ObservationKind::kLidar;
  bool knows_heading = false;  ///< at the start
  /// Of CMN in Habitat: the robot slides along walls and has no obstacle guard, each method has its
  /// own planner, and a map that is made of the world is of where the robot's middle can be.
  bool has_paper_setting = false;
  /// Once the robot is carried elsewhere, and its odometry does not notice (KidnapParams).
  bool kidnaps = false;

  /// Not what stands in the world is drawn but where the robot's middle can be.
  bool draws_middle() const { return has_paper_setting && drawing == DrawingKind::kCoarseGrid; }
};

/// Throws std::invalid_argument naming the known tasks.
const Task& find_task(const std::string& name);

/// The map of a task. `walls` are those of a generated house, null where nobody labelled them.
/// `radius_m`: of the robot.
Drawing draw(const Task& task, const CoarseMap& world, const CoarseMap* walls, double mpp,
             std::uint32_t seed, double radius_m);

}  // namespace cmn
