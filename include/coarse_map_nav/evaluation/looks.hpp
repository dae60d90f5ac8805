// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a robot's sensors measure where it stands, as much as its perception has a use for.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/perception/perception.hpp"
#include "coarse_map_nav/simulation/scene_sensors.hpp"

namespace cmn {

class Looks {
 public:
  /// `sensors` must outlive it.
  Looks(SceneSensors& sensors, const PerceptionParams& perception)
      : sensors_{sensors},
        uses_scan_{perception.uses_scan()},
        uses_depth_{perception.uses_depth()},
        uses_color_{perception.uses_color()} {}

  /// Valid until the next call. Each draws new noise.
  SensorData at(const Pose2& T_world_robot, double stamp_s) {
    SensorData data;
    if (uses_scan_) {
      scan_ = sensors_.scan(T_world_robot, stamp_s);
      data.scan = &scan_;
    }
    if (uses_depth_) {
      image_ = sensors_.depth(T_world_robot, stamp_s);
      data.image = &image_;
    }
    if (uses_color_) {
      color_ = sensors_.color(T_world_robot, stamp_s);
      data.color = &color_;
    }
    return data;
  }

 private:
  SceneSensors& sensors_;
  bool uses_scan_;
  bool uses_depth_;
  bool uses_color_;
  RangeScan scan_;
  DepthImage image_;
  ColorImage color_;
};

}  // namespace cmn
