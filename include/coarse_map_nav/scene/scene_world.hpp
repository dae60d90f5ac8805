// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A world with heights by its name: Gazebo world, extruded map or generated house.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/scene/furniture_meshes.hpp"
#include "coarse_map_nav/scene/scene.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cmn {

struct SceneWorldParams {
  double resolution_m = 0.05;
  double clear_m = 0.02;                            ///< what is lower does not stop the robot
  double robot_height_m = 0.6;                      ///< nor what hangs higher; LoCoBot's mast
  std::string furniture_folder = kFurnitureFolder;  ///< for houses; empty: boxes
};

/// A world to look around in, and the same as a map to drive in.
struct SceneWorld {
  std::shared_ptr<const MeshScene> scene;
  CoarseMap body;                     ///< free: where a robot's body can be
  bool is_map = false;                ///< read as one, and all of its walls are alike
  std::vector<std::string> warnings;  ///< what was survived, a sentence each, each once
};

/// The seed of house:SEED. None: not such a name. Throws std::runtime_error when SEED is no number
/// from 0 to 2^32 - 1.
std::optional<std::uint32_t> house_seed(const std::string& name);

/// Opens FILE.world or FILE.sdf (read_sdf), house:SEED (generate_house), or a map (read_map), whose
/// walls are 2.5 m high. Throws std::runtime_error with one sentence that names what is wrong.
SceneWorld open_scene_world(const std::string& name, const SceneWorldParams& params = {});

}  // namespace cmn
