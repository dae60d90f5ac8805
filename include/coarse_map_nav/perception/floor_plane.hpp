// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where the floor really is, for a camera that does not sit quite as its mount says.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"

#include <vector>

#include <Eigen/Core>

namespace cmn {

struct FloorParams {
  double tilt_deg = 3.0;
  double offset_m = 0.04;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("tilt_deg", self.tilt_deg, Between{0.0, 10.0},
          "[deg] depth: the floor may seem to slope by up to this, for the camera's mount is not "
          "quite true; 0: it is");
    visit("offset_m", self.offset_m, Between{0.0, 0.2},
          "[m] depth: and may seem to lie so much higher or lower under the camera");
  }
};

/// The floor as z = slope . (x, y) + offset_m, in the robot's axes from the point of the nominal
/// floor below the camera.
struct FloorPlane {
  Eigen::Vector2f slope = Eigen::Vector2f::Zero();  ///< [-]
  float offset_m = 0.0F;
  float at(float x, float y) const { return slope.x() * x + slope.y() * y + offset_m; }
};

/// Where a plane comes from.
enum class FloorSource { kNominal, kLast, kSeen };

/// Fits the floor to the points of one look, and remembers the last good fit.
///
/// Only points that could be floor by FloorParams take part. The plane that most of some planes
/// through three of them have near it (RANSAC, Fischler and Bolles 1981, with a seed of its own, so
/// that a look always gives the same) is fitted by least squares to what lies near it. Where too
/// little floor is in view to tell its slope, the last good plane stands in, or the nominal one.
class FloorEstimator {
 public:
  explicit FloorEstimator(const FloorParams& params);

  /// True for a point that could be floor.
  bool is_candidate(const Eigen::Vector3f& p) const;
  /// `candidates`: those points of a look, or some thousands of them, in the axes of FloorPlane.
  FloorPlane fit(const std::vector<Eigen::Vector3f>& candidates);
  /// Of the last fit().
  FloorSource source() const { return source_; }

  static constexpr float kReach_m = 3.0F;  ///< farther points are too noisy

 private:
  bool is_plausible(const FloorPlane& plane) const;

  FloorParams params_;
  float steepest_;  ///< slope [-] of `tilt_deg`
  FloorPlane last_;
  bool has_last_ = false;
  FloorSource source_ = FloorSource::kNominal;
};

}  // namespace cmn
