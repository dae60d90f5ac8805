// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The price of the cheapest way to the goal on a repaired map, from everywhere.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/grid.hpp"
#include "coarse_map_nav/planning/map_repair.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace cmn {

/// Dijkstra from the goal over the parts of a repaired map, four neighbours each; walls can be
/// crossed at their price, so there is a way from everywhere. The goal is where the robot is to
/// stand: its own part costs 1, whatever was learned of it.
///
/// The search goes only as far from the goal as it is asked about, and where the map changes only
/// what follows from the changes is searched again, and that too only as far as it is asked about
/// (after LPA*, Koenig and Likhachev 2004, without a heuristic). So a robot far from the goal pays
/// for what lies around it. All results are those of a search of the whole map from the beginning.
class RepairedCostToGo {
 public:
  RepairedCostToGo() = default;
  /// `goal` is a part of the map.
  RepairedCostToGo(const RepairedMap& map, Cell goal);
  /// These parts of the map, which otherwise is the same, cost something else now.
  void change(const RepairedMap& map, const std::vector<Cell>& parts);

  Cell goal() const { return goal_; }
  /// [steps into free parts]; kOutside outside.
  double operator()(Cell part) const;
  /// The same between the middles of parts, bilinear among those with no wall in between;
  /// `p_parts`: part (0, 0) from 0 to 1.
  double between(Point2 p_parts) const;
  /// The next part on a cheapest way to the goal, of equals the first in the order of kHeadings;
  /// none at the goal and outside.
  std::optional<Cell> next(Cell part) const;

 private:
  static constexpr double kOutside = 1e9;
  static constexpr std::int32_t kUnknown = std::numeric_limits<std::int32_t>::max();
  std::uint16_t price_of(const RepairedMap& map, Cell part) const {
    return static_cast<std::uint16_t>(part == goal_ ? 1 : map.cost(part));
  }
  bool contains(Cell c) const { return c.x >= 0 && c.y >= 0 && c.x < width_ && c.y < height_; }
  /// With a border of one part, all around, that is outside.
  std::size_t index_of(Cell c) const {
    return static_cast<std::size_t>(c.y + 1) * static_cast<std::size_t>(width_ + 2) +
           static_cast<std::size_t>(c.x + 1);
  }
  std::uint32_t neighbour(std::uint32_t i, Heading h) const {
    const Cell step = unit_step(h);
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(i) + step.y * (width_ + 2) +
                                      step.x);
  }
  /// It is looked at when the search comes to its cost.
  void wait(std::uint32_t i) const;
  /// What it costs by way of the neighbours that are nearer to the goal than `cost`.
  std::int32_t cost_through_nearer(std::uint32_t i, std::int32_t cost) const;
  void offer(std::uint32_t from) const;
  /// The way that it had is no more: takes the best that is known, and lets its neighbours, farther
  /// than that way was, look to theirs.
  void lose_way(std::uint32_t i, std::int32_t instead) const;
  /// Until all that costs no more is known.
  void search_to(std::int32_t cost) const;

  Cell goal_;
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint16_t> price_;  ///< of a step into each part
  // The search, which goes on when it is asked for more.
  mutable std::vector<std::int32_t> cost_;  ///< final where it is less than searched_
  mutable std::int32_t searched_ = 0;
  /// By their cost; of a part whose cost is another by now, nothing follows.
  mutable std::vector<std::vector<std::uint32_t>> waiting_;
};

}  // namespace cmn
