// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "worlds.hpp"

#include "coarse_map_nav/evaluation/given_drawing.hpp"
#include "coarse_map_nav/evaluation/house_generator.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/mapping/places.hpp"

#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>

namespace cmn {
namespace {

const std::string kHouse = "house:";
const std::string kFurnished = "furnished:";
constexpr std::uint32_t kMostHouses = 10000;
constexpr double kHouseCell_m = 0.05;

bool begins_with(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

/// "house:" or "furnished:"; empty: it is no generated house.
std::string prefix_of(const std::string& world) {
  return begins_with(world, kHouse) ? kHouse : begins_with(world, kFurnished) ? kFurnished : "";
}

std::uint32_t seed_of(const std::string& world) {
  const std::string prefix = prefix_of(world);
  const std::string digits = world.substr(prefix.size());
  if (digits.empty() || digits.size() > 9 ||
      digits.find_first_not_of("0123456789") != std::string::npos) {
    throw std::runtime_error(world + " is no house: " + prefix + "SEED or " + prefix +
                             "FIRST-LAST");
  }
  return static_cast<std::uint32_t>(std::stoul(digits));
}

bool is_gazebo(const std::string& world) {
  const std::string ending = std::filesystem::path{world}.extension().string();
  return ending == ".world" || ending == ".sdf";
}

SceneWorldParams scene_params(const JudgeParams& judge) {
  SceneWorldParams params;
  params.robot_height_m = judge.robot_height_m;
  return params;
}

}  // namespace

std::vector<std::string> expand_houses(const std::vector<std::string>& worlds) {
  std::vector<std::string> expanded;
  for (const std::string& world : worlds) {
    const std::string prefix = prefix_of(world);
    const std::size_t dash = world.find('-');
    if (prefix.empty() || dash == std::string::npos) {
      expanded.push_back(world);
      continue;
    }
    const std::uint32_t first = seed_of(world.substr(0, dash));
    const std::uint32_t last = seed_of(prefix + world.substr(dash + 1));
    if (first > last || last - first >= kMostHouses) {
      throw std::runtime_error(world + " are no houses, or too many");
    }
    for (std::uint32_t seed = first; seed <= last; ++seed) {
      expanded.push_back(prefix + std::to_string(seed));
    }
  }
  return expanded;
}

std::string scene_name(const std::string& world) {
  return prefix_of(world).empty() ? std::filesystem::path{world}.stem().string() : world;
}

bool has_heights(const std::string& world, const NavigatorParams& params) {
  return begins_with(world, kFurnished) || is_gazebo(world) || params.perception.uses_depth() ||
         params.perception.uses_color();
}

bool changes_with_heights(const std::string& world) { return begins_with(world, kHouse); }

Worlds::Worlds(const Plan& plan)
    : plan_{plan},
      store_{scene_params(plan.judge), plan.robot, static_cast<std::size_t>(plan.jobs) + 1} {}

const Scene& Worlds::open(const std::string& world, bool with_heights) {
  std::unique_ptr<Scene>& scene = scenes_[{world, with_heights}];
  if (scene) {
    return *scene;
  }
  try {
    scene = read(world, with_heights);
  } catch (const std::exception& e) {
    const std::string why = e.what();
    throw std::runtime_error(why.find(world) == std::string::npos ? world + ": " + why : why);
  }
  if (!plan_.map.empty()) {
    CoarseMap map = read_map(plan_.map);
    const std::vector<Place> places = read_places(plan_.map_to_world).places;
    try {
      scene->drawing = given_drawing(std::move(map), places, scene->map);
    } catch (const std::runtime_error& e) {
      throw std::runtime_error(plan_.map + " with " + plan_.map_to_world + ": " + e.what());
    }
  }
  return *scene;
}

std::unique_ptr<Scene> Worlds::read(const std::string& world, bool with_heights) {
  std::optional<House> house;
  if (!prefix_of(world).empty()) {
    house = generate_house(seed_of(world));
  }
  std::optional<CoarseMap> floor_plan;
  if (house) {
    floor_plan = walls(*house, kHouseCell_m);
  }
  if (!with_heights) {
    return std::make_unique<Scene>(scene_name(world),
                                   house ? occupancy(*house, kHouseCell_m) : read_map(world),
                                   floor_plan, plan_.judge);
  }
  const std::string name = house ? kHouse + std::to_string(seed_of(world)) : world;
  auto scene =
      std::make_unique<Scene>(scene_name(world), store_.body(name), floor_plan, plan_.judge);
  scene->sensors = store_.sensors(name);
  return scene;
}

}  // namespace cmn
