// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/places.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <yaml-cpp/yaml.h>

namespace cmn {
namespace {

YAML::Node load(const std::string& path) {
  try {
    const YAML::Node root = YAML::LoadFile(path);
    if (root.IsMap() || root.IsNull()) {
      return root;
    }
  } catch (const YAML::BadFile&) {
    throw std::runtime_error(path + ": cannot be opened; is the path right and readable?");
  } catch (const YAML::Exception& e) {
    throw std::runtime_error(path + ": is not YAML: " + e.what());
  }
  throw std::runtime_error(path + ": the top level is not a map of keys");
}

Point2 point_of(const YAML::Node& node, const std::string& path, const std::string& key) {
  Point2 p;
  if (!node || !node.IsSequence() || node.size() != 2 ||
      !YAML::convert<double>::decode(node[0], p.x) ||
      !YAML::convert<double>::decode(node[1], p.y) || !std::isfinite(p.x) || !std::isfinite(p.y)) {
    throw std::runtime_error(path + ": " + key + " must be [x, y], two finite numbers in metres");
  }
  return p;
}

}  // namespace

const Place* MapPlaces::find(const std::string& name) const {
  const auto found = std::find_if(places.begin(), places.end(),
                                  [&](const Place& place) { return place.name == name; });
  return found == places.end() ? nullptr : &*found;
}

MapPlaces read_places(const std::string& map_yaml_path) {
  const YAML::Node root = load(map_yaml_path);
  MapPlaces result;
  const YAML::Node places = root["places"];
  if (places && !places.IsMap()) {
    throw std::runtime_error(map_yaml_path +
                             ": places must be {name: {world: [x, y], map: [x, y]}, ...}");
  }
  for (const auto& entry : places) {
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
    const std::string key = "places/" + name;
    if (name.empty() || !entry.second.IsMap()) {
      throw std::runtime_error(map_yaml_path + ": " + key +
                               " must be {world: [x, y], map: [x, y]}");
    }
    if (result.find(name) != nullptr) {
      throw std::runtime_error(map_yaml_path + ": " + key + " is there twice");
    }
    result.places.push_back({name, point_of(entry.second["world"], map_yaml_path, key + "/world"),
                             point_of(entry.second["map"], map_yaml_path, key + "/map")});
  }
  if (const YAML::Node goal = root["default_goal"]) {
    result.default_goal = goal.IsScalar() ? goal.Scalar() : "";
    if (result.find(result.default_goal) == nullptr) {
      throw std::runtime_error(map_yaml_path + ": default_goal must be the name of one of places" +
                               (goal.IsScalar() ? ", not " + goal.Scalar() : ""));
    }
  }
  if (const YAML::Node world = root["world"]) {
    if (!world.IsScalar() || world.Scalar().empty()) {
      throw std::runtime_error(map_yaml_path + ": world must be the path of a YAML file");
    }
    const std::filesystem::path folder = std::filesystem::path{map_yaml_path}.parent_path();
    result.world = (folder / world.Scalar()).lexically_normal().string();
  }
  return result;
}

std::vector<Point2> read_starts(const std::string& world_yaml_path) {
  const YAML::Node root = load(world_yaml_path);
  std::vector<Point2> starts;
  const YAML::Node node = root["starts"];
  if (node && !node.IsSequence()) {
    throw std::runtime_error(world_yaml_path + ": starts must be [[x, y], ...]");
  }
  for (std::size_t i = 0; node && i < node.size(); ++i) {
    starts.push_back(point_of(node[i], world_yaml_path, "starts/" + std::to_string(i)));
  }
  return starts;
}

}  // namespace cmn
