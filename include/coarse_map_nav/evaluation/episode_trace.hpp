// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A judged episode action by action, and pictures of it.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/evaluation/episode_row.hpp"

#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// What was true and believed before an action.
struct TraceStep {
  Pose2 T_world_robot;
  Pose2 T_world_estimate;   ///< the estimate, taken from the drawing to the world
  double confidence = 0.0;  ///< share of the belief within 1 m of it
  double entropy = 0.0;     ///< of the belief [nats]
  int collisions = 0;       ///< so far
  bool is_converged = false;

  /// Off by no more than 1 m and less than 45 degrees.
  bool is_right() const;
  double off_m() const;
};

/// From the start to the last decision.
struct EpisodeTrace {
  EpisodeRow row;
  CoarseMap world;
  double success_radius_m = 0.4;
  double converged_confidence = 0.5;
  std::vector<TraceStep> steps;
};

/// The way and the estimates in the world, beside them error, confidence and entropy by action.
/// 8-bit BGR. Throws std::invalid_argument when there is no step.
cv::Mat trace_picture(const EpisodeTrace& trace);

/// The ways of several methods from one start to one goal. Throws std::invalid_argument when there
/// is none, or when they have not run the same episode.
cv::Mat trace_comparison(const std::vector<EpisodeTrace>& traces);

}  // namespace cmn
