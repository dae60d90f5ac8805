// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Worlds by their names, made ready for episodes.
#pragma once

#include "coarse_map_nav/evaluation/judged_episode.hpp"
#include "coarse_map_nav/params.hpp"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "plan.hpp"
#include "scene_store.hpp"

namespace cmn {

/// Worlds with house:FIRST-LAST and furnished:FIRST-LAST written out. Throws std::runtime_error
/// when it makes no sense.
std::vector<std::string> expand_houses(const std::vector<std::string>& worlds);
/// What a world is called in episodes: the name of its file, house:SEED or furnished:SEED.
std::string scene_name(const std::string& world);

/// Gazebo worlds and furnished houses are seen with heights by everyone, houses and maps by those
/// who look with a camera.
bool has_heights(const std::string& world, const NavigatorParams& params);
/// Whether it is another world with heights than without: a house, which then has the footprints
/// of its furniture, and not what a LiDAR sees of it, for obstacles.
bool changes_with_heights(const std::string& world);

/// Reads each world once.
class Worlds {
 public:
  /// `plan` must outlive it.
  explicit Worlds(const Plan& plan);

  /// A map, house or scene, and what drawing is given of it. Throws std::runtime_error naming the
  /// world, the drawing or the robot.
  const Scene& open(const std::string& world, bool with_heights);
  /// One that was opened before; by any thread, as long as none opens another.
  const Scene& opened(const std::string& world, bool with_heights) const {
    return *scenes_.at({world, with_heights});
  }

 private:
  std::unique_ptr<Scene> read(const std::string& world, bool with_heights);

  const Plan& plan_;
  SceneStore store_;
  std::map<std::pair<std::string, bool>, std::unique_ptr<Scene>> scenes_;
};

}  // namespace cmn
