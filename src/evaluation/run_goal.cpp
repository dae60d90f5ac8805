// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/run_goal.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace cmn {
namespace {

/// "x y" or "x, y", both finite, and nothing else.
std::optional<Point2> point_of(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream stream{text};
  Point2 p;
  std::string rest;
  if (!(stream >> p.x >> p.y) || stream >> rest || !std::isfinite(p.x) || !std::isfinite(p.y)) {
    return std::nullopt;
  }
  return p;
}

std::optional<Point2> map_to_world(std::vector<Place> places, Point2 p_map) {
  for (Place& place : places) {
    std::swap(place.world, place.map);
  }
  const std::optional<PlaceWarp> warp = warp_to_map(places);
  return warp ? std::optional<Point2>{warp->world_to_map(p_map)} : std::nullopt;
}

}  // namespace

std::pair<MapPlaces, bool> read_places_in(const std::string& map_path,
                                          const std::string& world_path) {
  if (std::filesystem::path{map_path}.extension() != ".yaml") {
    return {MapPlaces{}, true};
  }
  MapPlaces places = read_places(map_path);
  std::error_code error;
  const bool are_here =
      places.world.empty() || std::filesystem::equivalent(places.world, world_path, error);
  return {std::move(places), are_here};
}

std::optional<PlaceWarp> warp_to_map(const std::vector<Place>& places) {
  try {
    return PlaceWarp{places};
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

RunGoal goal_of(const std::string& text, const MapPlaces& places, bool are_here) {
  const std::string name = text.empty() ? places.default_goal : text;
  if (const Place* place = places.find(name)) {
    return {name, place->map, are_here ? std::optional<Point2>{place->world} : std::nullopt};
  }
  if (const std::optional<Point2> p = point_of(name)) {
    return {"(" + name + ")", *p, are_here ? map_to_world(places.places, *p) : std::nullopt};
  }
  std::string known;
  for (const Place& place : places.places) {
    known += (known.empty() ? "" : ", ") + place.name;
  }
  throw std::runtime_error(
      (name.empty() ? "no goal is given, and the drawing has no default_goal"
                    : "there is no place \"" + name + "\" on the drawing") +
      "; a goal is \"x y\" in metres on the drawing" +
      (known.empty() ? ": its file names no places" : " or one of its places: " + known));
}

}  // namespace cmn
