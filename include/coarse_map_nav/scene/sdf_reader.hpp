// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Gazebo worlds (.world, .sdf) -> MeshScene.
#pragma once

#include "coarse_map_nav/scene/scene.hpp"

#include <string>
#include <vector>

namespace cmn {

/// What of a model is read.
enum class SdfPart {
  kVisual,     ///< what cameras and a real LiDAR see
  kCollision,  ///< what Gazebo's physics and its plain ray sensor meet
};

/// Reads a world, or a model by itself, with all that it includes, by sdformat.
///
/// Models are looked for in model_folders(). Boxes, cylinders, spheres, capsules, ellipsoids,
/// planes and meshes are read, with their lights; a plane is as large as it says. A world without
/// lights keeps none. What can be survived (a model, mesh or texture that is missing or
/// broken, a geometry of another kind) is added to `warnings`, a sentence each. Throws
/// std::runtime_error, naming the file, when it is no SDF or nothing in it has a surface. One at a
/// time: sdformat has global settings.
MeshScene read_sdf(const std::string& path, std::vector<std::string>& warnings,
                   SdfPart part = SdfPart::kVisual);

}  // namespace cmn
