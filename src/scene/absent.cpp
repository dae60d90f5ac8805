// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Stands in for the files that need Embree, assimp, sdformat and libzip in a build without them.
#include "coarse_map_nav/scene/furniture_meshes.hpp"
#include "coarse_map_nav/scene/ray_caster.hpp"
#include "coarse_map_nav/scene/sdf_reader.hpp"

#include <stdexcept>

namespace cmn {
namespace {

[[noreturn]] void refuse() {
  throw std::runtime_error("the 3D simulator is left out of this build: " CMN_SCENE_ABSENT);
}

}  // namespace

std::unique_ptr<RayCaster> make_ray_caster(std::shared_ptr<const MeshScene> /*scene*/) { refuse(); }

std::unique_ptr<FurnitureMeshes> open_furniture(const std::string& /*folder*/) { refuse(); }

MeshScene read_sdf(const std::string& /*path*/, std::vector<std::string>& /*warnings*/,
                   SdfPart /*part*/) {
  refuse();
}

}  // namespace cmn
