// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Small scenes for tests, and cameras in them.
#pragma once

#include "coarse_map_nav/scene/ray_caster.hpp"
#include "coarse_map_nav/scene/scene.hpp"

#include <memory>

namespace cmn {

/// A closed box, 4 m x 5 m x 2.5 m, with a corner at the origin. Its faces look inwards.
inline MeshScene box_room() {
  MeshScene scene;
  add_box(scene, {4, 5, 2.5F}, {0, 0, 0}, scene.add_material({"wall", {0.8F, 0.8F, 0.8F}, {}}));
  return scene;
}

inline std::unique_ptr<RayCaster> caster_of(const MeshScene& scene) {
  return make_ray_caster(std::make_shared<const MeshScene>(scene));
}

/// A camera that looks along the scene's x axis.
inline Eigen::Isometry3d looking_ahead(double x, double y, double z) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d{x, y, z};
  T.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return T;
}

}  // namespace cmn
