// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// From what the sensors measured to what the filter, the planner and the motion are told.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/data/point_cloud.hpp"
#include "coarse_map_nav/perception/accumulator.hpp"
#include "coarse_map_nav/perception/color_looks.hpp"
#include "coarse_map_nav/perception/depth_projection.hpp"
#include "coarse_map_nav/perception/obstacle_guard.hpp"
#include "coarse_map_nav/perception/occupancy_predictor.hpp"
#include "coarse_map_nav/perception/panorama.hpp"
#include "coarse_map_nav/perception/predicted_scan.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"
#include "coarse_map_nav/perception/rolling_map.hpp"

#include <memory>
#include <string>

namespace cmn {

struct PerceptionParams {
  std::string source = "lidar";
  std::string accumulate = "none";
  std::string accumulate_local_map = "same";
  double grow_m = 0.0;
  DepthParams depth;
  RgbParams rgb;
  PanoramaParams panorama;
  RollingMapParams rolling;
  ProjectionParams local_occupancy;
  ProjectionParams local_map{160, 8.0, 0.0};
  ObstacleGuardParams guard;
  bool uses_scan() const { return source != "depth"; }
  bool uses_depth() const { return source == "depth" || source == "fused"; }
  bool uses_color() const { return source == "rgb"; }
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("source", self.source, OneOf{{"lidar", "depth", "fused", "rgb"}},
          "what local occupancy is made from: a LiDAR, a depth camera, both (fused), or a colour "
          "camera and a network (rgb); of fused and rgb a LiDAR alone guards the motion");
    visit("accumulate", self.accumulate, OneOf{{"none", "panorama", "rolling"}},
          "none: each look by itself; panorama: four looks, a quarter turn apart, are one (CMN); "
          "rolling: what was seen lately is kept (CMP eq. 1 to 3)");
    visit("accumulate_local_map", self.accumulate_local_map, OneOf{{"same", "rolling"}},
          "likewise of what the planner is told; same: as accumulate says; rolling: for a camera "
          "that does not see what is near, and has seen it before");
    visit("grow_m", self.grow_m, Between{0.0, 1.0},
          "[m] what the localizer is told of is larger by it all round: the robot's radius where "
          "the drawing is of where its middle can be; 0: the drawing is of what stands there");
    visit.group("depth", self.depth);
    visit.group("rgb", self.rgb);
    visit.group("panorama", self.panorama);
    visit.group("rolling", self.rolling);
    visit.group("local_occupancy", self.local_occupancy);
    visit.group("local_map", self.local_map);
    visit.group("guard", self.guard);
  }
};

/// What the sensors measured at one moment, not owned. Null is what the source has no use for, and
/// one of `image` and `cloud` is enough.
struct SensorData {
  const RangeScan* scan = nullptr;
  const DepthImage* image = nullptr;
  const PointCloudView* cloud = nullptr;
  const ColorImage* color = nullptr;
};

/// What is made of them.
struct Percept {
  LocalOccupancy seen;       ///< by the localizer
  LocalOccupancy local_map;  ///< for the planner; empty where it was not asked for
  double clear_ahead_m = 0.0;
  bool is_complete = true;  ///< false: the robot should turn to the left and look again
  BeamCount beams;          ///< of the scan that guards
};

/// Of two looks on the same cells, about the same robot: nearest obstacle wins. A cell is occupied
/// where either saw something, unseen where it lies behind what either saw, else free where either
/// saw it to be. A LiDAR sees through below a table whose edge a depth camera sees.
LocalOccupancy nearest_of(const LocalOccupancy& a, const LocalOccupancy& b);

class Perception {
 public:
  /// `predictor`: of the source "rgb", shared with nobody at the same time. Throws
  /// std::invalid_argument when a word of `params` is unknown or the predictor is missing.
  explicit Perception(const PerceptionParams& params,
                      std::shared_ptr<OccupancyPredictor> predictor = nullptr);

  /// Of both sensors, ground that the LiDAR alone sees to be free is presumed to be (kPresumed).
  /// `data` was measured with the robot at `T_odom_robot`, which `accumulate: none` makes no use
  /// of.
  Percept look(const SensorData& data, const Pose2& T_odom_robot, bool with_local_map);
  /// The guard's word alone, without folding anything in.
  double clear_ahead_m(const SensorData& data);
  /// The odometry jumped.
  void forget();
  /// Of the last look of a depth camera.
  const DepthReport& depth_report() const { return depth_.report(); }

 private:
  /// A grid about the robot and what is made of looks on it.
  struct View {
    View(const PerceptionParams& params, const ProjectionParams& grid,
         const std::string& accumulate);
    RangeProjector projector;         ///< of the sensor that guards
    RangeProjector camera_projector;  ///< of the camera beside a LiDAR
    std::unique_ptr<Accumulator> accumulator;
  };
  RangeScan depth_scan(const SensorData& data);
  /// Of the camera beside the LiDAR: none while a panorama is incomplete.
  RangeScan camera_scan(const SensorData& data, const Pose2& T_odom_robot);

  PerceptionParams params_;
  DepthProjector depth_;
  std::shared_ptr<OccupancyPredictor> predictor_;
  ColorLooks color_looks_;
  View seen_;
  View local_map_;
};

}  // namespace cmn
