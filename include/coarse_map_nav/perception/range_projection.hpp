// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Ranges of a planar sensor -> occupancy around the robot.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/param_tree.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cmn {

/// One sweep of a planar LiDAR, as in sensor_msgs/LaserScan.
///
/// +inf, or anything above `range_max_m`, is a beam that met nothing (REP-117); NaN, negative and
/// too short ranges are no measurement at all.
struct RangeScan {
  double stamp_s = 0.0;
  double angle_min_rad = 0.0;        ///< of the first beam, in the sensor's frame
  double angle_increment_rad = 0.0;  ///< between neighbours; negative for a clockwise sensor
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  std::vector<float> ranges_m;
  Pose2 T_robot_sensor;

  /// How far a beam saw whatever stands in its way.
  struct Sight {
    float from_m = 0.0F;  ///< nearer the ground is taken to be free, though nobody saw it
    float to_m = 0.0F;    ///< so far it is free if the beam met nothing
  };
  /// Of each beam of a sensor that looks down at the floor. Empty: from 0 to range_max_m.
  std::vector<Sight> sights;
  ObservationSource source = ObservationSource::kLidar;
};

struct ProjectionParams {
  int size = 128;        ///< CMN: 128 x 128 ...
  double side_m = 1.28;  ///< ... over 1.28 m
  double wall_m = 0.0;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("size", self.size, Between{3, 1024}, "[cells] side of the local occupancy grid");
    visit("side_m", self.side_m, Between{0.1, 50.0}, "[m] side of the local occupancy grid");
    visit("wall_m", self.wall_m, Between{0.0, 2.0},
          "[m] behind a hit so much, at least one cell, is taken as seen to be occupied");
  }
};

/// What was wrong with the beams of a scan.
struct BeamCount {
  std::size_t used = 0;
  std::size_t unusable = 0;  ///< NaN, negative, -inf or below range_min
};

/// Turns scans into local occupancy (Robb, "LiDAR local occupancy").
///
/// A cell is free (0) up to the range of the beam through its middle and occupied (1) from there on
/// for one cell's diagonal, both with confidence 1. What lies beyond is unseen: confidence 0 and
/// occupancy 1, Robb's "everything beyond is occupied"; who trusts only what was seen looks at the
/// confidence. Bearings outside the field of view and unusable beams leave 0.5 with confidence 0.
/// Nearer than the sight of a beam begins, free cells have the confidence kPresumed, and so has the
/// ground between the robot's middle and a camera before it, which no beam crosses.
/// In a dense scan, a lone beam that met nothing between two that hit is taken to be free only as
/// far as they were: most lidars report a lost echo so.
/// Each cell's bearing and distance are tabulated for the sensor at hand, so that a scan costs one
/// look-up a cell.
class RangeProjector {
 public:
  explicit RangeProjector(const ProjectionParams& params) : params_{params} {}

  LocalOccupancy project(const RangeScan& scan, BeamCount* count = nullptr);

 private:
  /// A cell as the sensor sees it.
  struct Bearing {
    std::uint32_t beam;  ///< the nearest; outside the field of view one of the two after the last
    float range_m;       ///< distance of the cell's middle from the sensor
  };
  void tabulate(const RangeScan& scan);

  ProjectionParams params_;
  RangeScan layout_;  ///< what bearings_ was made for; its ranges stay empty
  std::size_t layout_beams_ = 0;
  std::vector<Bearing> bearings_;
};

}  // namespace cmn
