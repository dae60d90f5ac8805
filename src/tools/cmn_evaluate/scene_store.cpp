// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene_store.hpp"

#include "coarse_map_nav/simulation/robot_description.hpp"

#include <algorithm>
#include <iostream>
#include <utility>

namespace cmn {

SceneStore::SceneStore(SceneWorldParams params, std::filesystem::path robot, std::size_t most)
    : params_{std::move(params)}, robot_{std::move(robot)}, most_{most} {}

CoarseMap SceneStore::body(const std::string& name) {
  if (!mounts_) {
    const RobotDescription description = read_robot_description(robot_.string());
    mounts_ = mounts_of(description, description.root, {});
  }
  SceneWorld world = open_scene_world(name, params_);
  if (!world.warnings.empty()) {
    std::cerr << name << ": " << world.warnings.size()
              << " warnings of textures or models; cmn_scene --world " << name << " lists them\n";
  }
  const std::lock_guard<std::mutex> lock{mutex_};
  keep(name, make_ray_caster(world.scene));
  return std::move(world.body);
}

SensorMaker SceneStore::sensors(const std::string& name) {
  return [this, name](const LidarParams& lidar, std::uint32_t seed) {
    RayCastSensorParams params;
    params.lidar = lidar;
    SensorMounts mounts = *mounts_;
    if (lidar.field_of_view_deg < 360.0) {
      mounts.T_robot_lidar.linear().setIdentity();
    }
    return std::make_unique<RayCastSensors>(caster(name), params, mounts, seed);
  };
}

std::shared_ptr<const RayCaster> SceneStore::caster(const std::string& name) {
  const std::lock_guard<std::mutex> lock{mutex_};
  const auto found = std::find_if(opened_.begin(), opened_.end(),
                                  [&](const auto& opened) { return opened.first == name; });
  if (found == opened_.end()) {
    keep(name, make_ray_caster(open_scene_world(name, params_).scene));
  } else {
    opened_.splice(opened_.begin(), opened_, found);
  }
  return opened_.front().second;
}

void SceneStore::keep(const std::string& name, std::shared_ptr<const RayCaster> caster) {
  opened_.emplace_front(name, std::move(caster));
  if (opened_.size() > most_) {
    opened_.pop_back();
  }
}

}  // namespace cmn
