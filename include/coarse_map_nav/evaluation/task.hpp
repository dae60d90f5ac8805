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

enum class DrawingKind { kCoarseGrid, kHandDrawn, kWallsOnly };
enum class ObservationKind {
  kTrueCrop,     ///< the true 3 x 3 crop of the map (CMN, "grid observations")
  kLidar,        ///< 360 deg
  kForwardLidar  ///< 180 deg, forward-facing
};

struct Task {
  std::string name;
  DrawingKind drawing = DrawingKind::kCoarseGrid;
  ObservationKind observation = ObservationKind::kLidar;
  bool knows_heading = false;      ///< at the start
  bool has_paper_setting = false;  ///< sliding along walls, each method's own planner
};

/// Throws std::invalid_argument naming the known tasks.
const Task& find_task(const std::string& name);

/// The map of a task. `walls` are those of a generated house, null where nobody labelled them.
Drawing draw(const Task& task, const CoarseMap& world, const CoarseMap* walls, double mpp,
             std::uint32_t seed);

}  // namespace cmn
