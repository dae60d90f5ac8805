// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// House -> MeshScene: a generated home to be looked at.
#pragma once

#include "coarse_map_nav/evaluation/house.hpp"
#include "coarse_map_nav/scene/furniture_meshes.hpp"
#include "coarse_map_nav/scene/scene.hpp"

#include <cstdint>

namespace cmn {

/// Walls, floors, ceilings, doors that stand open, windows, a lamp in every room, and the
/// furniture: of `meshes` what fits, else (or with none) its boxes and cylinders. Colours, patterns
/// and meshes are drawn from the seed. The frame is the house's, the floor at height 0.
MeshScene house_scene(const House& house, std::uint32_t seed, FurnitureMeshes* meshes = nullptr);

}  // namespace cmn
