// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Named places that exist both in a metric world and on a drawing of it.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <string>
#include <vector>

namespace cmn {

/// One place, seen from both sides.
struct Place {
  std::string name;
  Point2 world;  ///< [m] in the frame of the metric world
  Point2 map;    ///< [m, nominal] in the map frame of the drawing
};

/// The places of a drawing, in the order of the file.
struct MapPlaces {
  std::vector<Place> places;
  std::string default_goal;  ///< the name of one of the places, or empty
  std::string world;         ///< path of the world's YAML file that they lie in, or empty

  /// The place of that name, or nullptr.
  const Place* find(const std::string& name) const;
};

/// Reads the blocks that this package adds to a map's YAML file:
///
///     places: {kitchen: {world: [x, y], map: [x, y]}, ...}
///     default_goal: kitchen
///     world: ../worlds/home.yaml    (relative to the map's file)
///
/// Absent blocks give an empty result. Throws std::runtime_error naming the file and the key that
/// is malformed. Neither the robot nor its planner knows `world`: it serves scoring and pictures.
MapPlaces read_places(const std::string& map_yaml_path);

/// Reads the block `starts: [[x, y], ...]` [m] of a world's YAML file; empty when absent. Throws
/// as read_places.
std::vector<Point2> read_starts(const std::string& world_yaml_path);

}  // namespace cmn
