// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The rays of a camera's pixels.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/scene/ray_caster.hpp"

#include <cstddef>
#include <vector>

namespace cmn {

/// A pose on the floor as one in space.
Eigen::Isometry3d in_space(const Pose2& T_world_robot);

/// One ray a pixel, or a square of them. Their order is that of small tiles, so that rays which are
/// cast together lie together.
class CameraRays {
 public:
  /// `samples` x `samples` rays a pixel, evenly spread over it.
  explicit CameraRays(const CameraModel& camera, int samples = 1);

  /// Ways along the rays are depths along the optical axis.
  const std::vector<SceneRay>& from(const Eigen::Isometry3d& T_world_camera, float reach);
  /// Of a ray: row by row from the upper left.
  std::size_t pixel_of(std::size_t ray) const { return pixels_[ray]; }
  std::size_t size() const { return pixels_.size(); }

 private:
  std::vector<std::size_t> pixels_;
  std::vector<Eigen::Vector3f> directions_;  ///< in the optical frame, z = 1
  std::vector<SceneRay> rays_;
};

}  // namespace cmn
