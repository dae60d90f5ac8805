// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/camera_rays.hpp"

#include <algorithm>

namespace cmn {
namespace {

// As many rays as a ray caster takes at once.
constexpr int kTileWidth = 4;
constexpr int kTileHeight = 2;

}  // namespace

Eigen::Isometry3d in_space(const Pose2& T_world_robot) {
  return Eigen::Translation3d{T_world_robot.x, T_world_robot.y, 0.0} *
         Eigen::Isometry3d{Eigen::AngleAxisd{T_world_robot.yaw, Eigen::Vector3d::UnitZ()}};
}

CameraRays::CameraRays(const CameraModel& camera, int samples) {
  const int width = camera.width * samples;
  const int height = camera.height * samples;
  const auto coordinate = [samples](int i) { return (i + 0.5) / samples - 0.5; };  // [pixels]
  for (int top = 0; top < height; top += kTileHeight) {
    for (int left = 0; left < width; left += kTileWidth) {
      for (int y = top; y < std::min(top + kTileHeight, height); ++y) {
        for (int x = left; x < std::min(left + kTileWidth, width); ++x) {
          pixels_.push_back(static_cast<std::size_t>(y / samples) *
                                static_cast<std::size_t>(camera.width) +
                            static_cast<std::size_t>(x / samples));
          directions_.emplace_back(static_cast<float>((coordinate(x) - camera.cx) / camera.fx),
                                   static_cast<float>((coordinate(y) - camera.cy) / camera.fy),
                                   1.0F);
        }
      }
    }
  }
  rays_.resize(directions_.size());
}

const std::vector<SceneRay>& CameraRays::from(const Eigen::Isometry3d& T_world_camera,
                                              float reach) {
  const Eigen::Matrix3f turn = T_world_camera.linear().cast<float>();
  const Eigen::Vector3f origin = T_world_camera.translation().cast<float>();
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    rays_[i] = {origin, turn * directions_[i], reach};
  }
  return rays_;
}

}  // namespace cmn
