// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Starts and goals of episodes, and the shortest way between them.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/grid.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <vector>

namespace cmn {

struct Route {
  Pose2 T_world_start;
  Point2 goal_world;
  double shortest_m = 0.0;
};

/// Draws routes through all places of a world that a disc can reach from one another.
///
/// Lengths are those of shortest ways over eight neighbours on a grid of 0.1 m (up to 8 % above
/// the Euclidean shortest way, never below it).
class RouteSampler {
 public:
  /// `extent`: the map that `world` was made of. Throws std::runtime_error when no disc of
  /// `radius_m` fits anywhere.
  RouteSampler(const World& world, const CoarseMap& extent, double radius_m);

  /// Start, one of four headings and goal uniform over the largest drivable region, with a way of
  /// `least_m` to `most_m` between them; `may_be_goal` refuses goals. None when hardly any start
  /// has such a goal.
  std::optional<Route> sample(double least_m, double most_m,
                              const std::function<bool(Point2)>& may_be_goal,
                              std::mt19937_64& rng) const;
  /// Likewise to a given goal; `may_be_start` refuses starts, which are drawn in the same order
  /// whatever it says.
  std::optional<Route> sample_to(Point2 goal_world, double least_m, double most_m,
                                 const std::function<bool(Point2)>& may_be_start,
                                 std::mt19937_64& rng) const;
  /// Free ground of the largest drivable region [m2].
  double drivable_m2() const;

 private:
  /// Whole tenths of a millimetre from `from` to every cell within `most_m`; kFar beyond.
  Grid<std::int32_t> ways_from(Cell from, double most_m) const;
  Point2 to_world(Cell c) const;
  Route route(Cell start, Point2 goal_world, std::size_t quarter, std::int32_t way) const;

  Pose2 T_world_grid_;
  Grid<std::uint8_t> is_drivable_;  ///< one cell of border, not drivable
  std::vector<Cell> cells_;         ///< of the largest region
};

}  // namespace cmn
