// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/given_drawing.hpp"

#include "coarse_map_nav/mapping/place_warp.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace cmn {
namespace {

constexpr double kApart_m = 0.5;  ///< points of the world that are looked at
constexpr double kLeastCovered = 0.5;

/// Of a drawing that says nothing of its scale yet.
double mean_scale(const Drawing& drawing, const CoarseMap& world) {
  const int stride = std::max(1, static_cast<int>(std::lround(kApart_m / world.resolution())));
  int points = 0;
  int covered = 0;
  double sum = 0.0;
  for (int y = stride / 2; y < world.height(); y += stride) {
    for (int x = stride / 2; x < world.width(); x += stride) {
      if (world.is_occupied({x, y})) {
        continue;
      }
      const Point2 p = world.center_of({x, y});
      const double determinant = drawing.jacobian(p).determinant();
      std::ostringstream text;
      if (!(determinant > 0.0)) {
        text << "the places fold or mirror the world near (" << p.x << ", " << p.y << ")";
        throw std::runtime_error(text.str());
      }
      ++points;
      covered += drawing.map().contains(drawing.map().cell_of(drawing.world_to_map(p)));
      sum += std::sqrt(determinant);
    }
  }
  if (covered <= kLeastCovered * points) {
    std::ostringstream text;
    text << "the map covers " << covered << " of " << points
         << " points of the world's free ground: is it of this world, and are the places right?";
    throw std::runtime_error(text.str());
  }
  return sum / points;
}

}  // namespace

Drawing given_drawing(CoarseMap map, const std::vector<Place>& places, const CoarseMap& world) {
  std::vector<Place> swapped = places;
  for (Place& place : swapped) {
    std::swap(place.world, place.map);
  }
  const Drawing unscaled{map, PlaceWarp{places}, PlaceWarp{swapped}, 1.0};
  const double scale = mean_scale(unscaled, world);
  return {std::move(map), PlaceWarp{places}, PlaceWarp{swapped}, scale};
}

}  // namespace cmn
