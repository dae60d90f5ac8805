// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Meshes for the furniture of a house.
#pragma once

#include "coarse_map_nav/evaluation/house.hpp"
#include "coarse_map_nav/scene/scene.hpp"

#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace cmn {

/// Where Debian's package sweethome3d-furniture puts its libraries.
constexpr const char* kFurnitureFolder = "/usr/share/sweethome3d/furniture";

/// A stock of furniture.
class FurnitureMeshes {
 public:
  virtual ~FurnitureMeshes() = default;
  /// A mesh of the piece's kind in the piece's frame, stretched to fill its footprint and height
  /// exactly; one drawn of those that need little stretching. None: nothing fits. Meshes stay in
  /// memory once read.
  virtual std::optional<MeshScene> fit(const Furniture& piece, std::mt19937_64& rng) = 0;
  /// What went wrong so far, a sentence each.
  virtual const std::vector<std::string>& warnings() const = 0;
};

/// The furniture libraries (.sh3f) of Sweet Home 3D in a folder. Null when there are none.
std::unique_ptr<FurnitureMeshes> open_furniture(const std::string& folder = kFurnitureFolder);

}  // namespace cmn
