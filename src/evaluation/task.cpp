// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/task.hpp"

#include "coarse_map_nav/mapping/turned_map.hpp"

#include <stdexcept>

namespace cmn {
namespace {

const std::vector<Task>& tasks() {
  using D = DrawingKind;
  using O = ObservationKind;
  static const std::vector<Task> kTasks{
      {"CG", D::kCoarseGrid, O::kTrueCrop, true, true},
      {"CI", D::kCoarseGrid, O::kColorPanorama, true, true},
      {"HD", D::kHandDrawn, O::kColorPanorama, true, true},
      {"CL", D::kCoarseGrid, O::kLidar, false, false},
      {"CD", D::kCoarseGrid, O::kDepthPanorama, false, false},
      {"CF", D::kCoarseGrid, O::kForward, false, false},
      {"HL", D::kHandDrawn, O::kLidar, false, false},
      {"WL", D::kWallsOnly, O::kLidar, false, false},
      {"TL", D::kTurnedGrid, O::kLidar, false, false},
      {"CLK", D::kCoarseGrid, O::kLidar, false, false, true},
      {"CFK", D::kCoarseGrid, O::kForward, false, false, true},
      {"HLK", D::kHandDrawn, O::kLidar, false, false, true},
      {"WLK", D::kWallsOnly, O::kLidar, false, false, true},
  };
  return kTasks;
}

}  // namespace

const Task& find_task(const std::string& name) {
  std::string known;
  for (const Task& task : tasks()) {
    if (task.name == name) {
      return task;
    }
    known += (known.empty() ? "" : ", ") + task.name;
  }
  throw std::invalid_argument("task \"" + name + "\" is none of " + known);
}

Drawing draw(const Task& task, const CoarseMap& world, const CoarseMap* walls, double mpp,
             std::uint32_t seed, double radius_m) {
  switch (task.drawing) {
    case DrawingKind::kHandDrawn:
      return hand_drawn(world, mpp, seed);
    case DrawingKind::kWallsOnly:
      return walls != nullptr ? coarse_grid(*walls, mpp) : walls_only(world, mpp);
    case DrawingKind::kTurnedGrid:
      return coarse_grid(turned_map(world, kDrawingTurn_rad), mpp);
    case DrawingKind::kCoarseGrid:
      break;
  }
  return coarse_grid(world, mpp, task.draws_middle() ? radius_m : 0.0);
}

}  // namespace cmn
