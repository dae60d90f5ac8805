// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One journey to a goal, as it is kept for pictures and summaries.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/grid.hpp"
#include "coarse_map_nav/mapping/place_warp.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cmn {

/// What stays the same all the way.
struct RunSetting {
  CoarseMap map;                     ///< the drawing
  Point2 goal_map;                   ///< [m] as marked on it
  std::optional<CoarseMap> world;    ///< the metric one that is driven in
  std::optional<Point2> goal_world;  ///< [m] where the goal really is
  std::optional<PlaceWarp> warp;     ///< shows the truth on the drawing
  std::string time_unit = "s";       ///< of all times: what is written after them
};

/// What was believed at one moment, and what was true.
struct RunMoment {
  double time_s = 0.0;   ///< since the goal was set
  Grid<float> marginal;  ///< P(cell) on the drawing
  Pose2 T_map_estimate;
  double confidence = 0.0;
  bool converged = false;
  std::optional<Pose2> T_world_robot;  ///< the truth, where it is known
  std::optional<Pose2> T_map_robot;    ///< the same on the drawing; empty: by the setting's warp
};

/// One point of the true path.
struct TrackPoint {
  double time_s = 0.0;  ///< since the goal was set
  Pose2 T_world_robot;
};

/// What happened on the way. Pictures need a few hundred moments at most: a journey of any length
/// stays small.
class RunRecord {
 public:
  /// Keeps the first moment, the last and at most kMostMoments evenly spread ones.
  void add(RunMoment moment);
  /// Keeps the pose when it differs by 2 cm, 5 degrees or 1 s from the last one kept.
  void add(const TrackPoint& point);

  const std::vector<RunMoment>& moments() const { return moments_; }
  const std::vector<TrackPoint>& track() const { return track_; }
  /// The length of the track.
  double driven_m() const { return driven_m_; }
  /// The truth at the moment of an observation: the last pose kept that is not later; empty before
  /// the first.
  std::optional<Pose2> truth_at(double time_s) const;
  double duration_s() const;

  static constexpr std::size_t kMostMoments = 240;

 private:
  std::vector<RunMoment> moments_;
  std::vector<TrackPoint> track_;
  double driven_m_ = 0.0;
  std::size_t seen_ = 0;    ///< moments
  std::size_t stride_ = 1;  ///< of which every so many-th is kept
};

}  // namespace cmn
