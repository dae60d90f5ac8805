// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Mesh files -> MeshScene, by Open Asset Import (COLLADA, OBJ, glTF, STL, ...).
#pragma once

#include "coarse_map_nav/scene/scene.hpp"
#include "coarse_map_nav/scene/zip_archive.hpp"

#include <string>
#include <vector>

namespace cmn {

/// Reads a mesh with its materials and textures. COLLADA and glTF come out z up and in metres,
/// whatever the file's own axis and unit; other formats as they are.
///
/// Textures are looked for where the file says, beside it, and in ../materials/textures, as Gazebo
/// does. What can be survived (a texture that is missing or unreadable, broken triangles) is added
/// to `warnings`, a sentence each. Throws std::runtime_error, naming the file, when no triangle
/// comes of it. Another process reads the file first, since some broken ones crash their reader.
MeshScene read_mesh(const std::string& path, std::vector<std::string>& warnings);

/// The same of a file inside a zip archive; so are its textures.
MeshScene read_mesh(const ZipArchive& archive, const std::string& file,
                    std::vector<std::string>& warnings);

}  // namespace cmn
