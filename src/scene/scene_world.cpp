// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/scene_world.hpp"

#include "coarse_map_nav/evaluation/house_generator.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/scene/extrusion.hpp"
#include "coarse_map_nav/scene/house_scene.hpp"
#include "coarse_map_nav/scene/sdf_reader.hpp"
#include "coarse_map_nav/scene/slice.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace cmn {
namespace {

/// Each once, in their order: a texture that many surfaces lack is one thing to mend.
std::vector<std::string> without_repeats(const std::vector<std::string>& warnings) {
  std::set<std::string> told;
  std::vector<std::string> kept;
  std::copy_if(warnings.begin(), warnings.end(), std::back_inserter(kept),
               [&](const std::string& warning) { return told.insert(warning).second; });
  return kept;
}

SceneWorld open_house(std::uint32_t seed, const SceneWorldParams& params) {
  SceneWorld world;
  std::unique_ptr<FurnitureMeshes> meshes;
  if (!params.furniture_folder.empty()) {
    meshes = open_furniture(params.furniture_folder);
    if (!meshes) {
      world.warnings.push_back("no furniture libraries in " + params.furniture_folder +
                               " (Debian: sweethome3d-furniture): boxes instead");
    }
  }
  world.scene =
      std::make_shared<const MeshScene>(house_scene(generate_house(seed), seed, meshes.get()));
  if (meshes) {
    world.warnings = meshes->warnings();
  }
  return world;
}

}  // namespace

std::optional<std::uint32_t> house_seed(const std::string& name) {
  const std::string prefix = "house:";
  if (name.rfind(prefix, 0) != 0) {
    return std::nullopt;
  }
  std::uint32_t seed = 0;
  const char* end = name.data() + name.size();
  const auto read = std::from_chars(name.data() + prefix.size(), end, seed);
  if (read.ec != std::errc{} || read.ptr != end) {
    throw std::runtime_error(name + ": a house has a number, for example house:3");
  }
  return seed;
}

SceneWorld open_scene_world(const std::string& name, const SceneWorldParams& params) {
  SceneWorld world;
  const std::string ending = std::filesystem::path{name}.extension().string();
  if (const auto seed = house_seed(name)) {
    world = open_house(*seed, params);
  } else if (ending == ".world" || ending == ".sdf") {
    world.scene = std::make_shared<const MeshScene>(read_sdf(name, world.warnings));
  } else {
    world.is_map = true;
    world.body = read_map(name);
    world.scene = std::make_shared<const MeshScene>(extrude(world.body));
    return world;
  }
  world.warnings = without_repeats(world.warnings);
  SliceParams cut;
  cut.resolution_m = params.resolution_m;
  cut.band = {params.clear_m, params.robot_height_m};
  try {
    world.body = slice(*world.scene, cut);
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(name + ": " + e.what());
  }
  return world;
}

}  // namespace cmn
