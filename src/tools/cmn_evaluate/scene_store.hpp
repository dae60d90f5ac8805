// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Worlds with heights for episodes.
#pragma once

#include "coarse_map_nav/evaluation/judged_episode.hpp"
#include "coarse_map_nav/scene/ray_cast_sensors.hpp"
#include "coarse_map_nav/scene/ray_caster.hpp"
#include "coarse_map_nav/scene/scene_world.hpp"
#include "coarse_map_nav/simulation/sensor_mounts.hpp"

#include <cstddef>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace cmn {

/// Opens worlds with heights and lends their triangles to the sensors in them. These take up some
/// hundred megabytes a house, so that only the last few stay in memory; the others are opened anew
/// when they are looked at again. Several threads may use one.
class SceneStore {
 public:
  /// Keeps the last `most` >= 1. `robot` is the file of its description, read with the first world.
  SceneStore(SceneWorldParams params, std::filesystem::path robot, std::size_t most);

  /// What stops a robot in a world, by its name as open_scene_world() takes it. Throws what that
  /// does, and std::runtime_error for a robot that cannot be read or in a build without the 3D
  /// simulator.
  CoarseMap body(const std::string& name);
  /// Of robots in that world. A LiDAR that does not look all round looks forward, however it is
  /// mounted. The store must outlive what is made.
  SensorMaker sensors(const std::string& name);

 private:
  std::shared_ptr<const RayCaster> caster(const std::string& name);
  /// Holding the lock.
  void keep(const std::string& name, std::shared_ptr<const RayCaster> caster);

  SceneWorldParams params_;
  std::filesystem::path robot_;
  std::optional<SensorMounts> mounts_;
  std::size_t most_;
  std::mutex mutex_;
  /// The last used first.
  std::list<std::pair<std::string, std::shared_ptr<const RayCaster>>> opened_;
};

}  // namespace cmn
