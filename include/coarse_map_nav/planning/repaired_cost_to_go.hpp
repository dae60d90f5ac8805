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
#include <optional>
#include <vector>

namespace cmn {

/// Dijkstra from the goal over the parts of a repaired map, four neighbours each; walls can be
/// crossed at their price, so there is a way from everywhere.
///
/// The search goes only as far from the goal as it is asked about. Where the map changes so that
/// cheapest ways do, it goes back to the nearest change and on from there: with the goal ahead and
/// changes around the robot, only what lies about as far from the goal as they do is searched
/// again. By Dial's queue; all results are those of a search of the whole map from the beginning.
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
  /// The next part on a cheapest way to the goal; none at the goal and outside.
  std::optional<Cell> next(Cell part) const;

 private:
  static constexpr double kOutside = 1e9;
  struct Part {
    std::int32_t cost;    ///< final when it is no more than searched_
    std::uint16_t price;  ///< of a step into it; 0: outside
    Heading towards;      ///< to the next part
  };
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
  void offer(std::uint32_t from, std::int32_t least) const;
  /// Until all that costs no more is known.
  void search_to(std::int32_t cost) const;
  void go_back_to(std::int32_t cost);
  /// A part that was searched has another price: does anything follow?
  bool matters(std::uint32_t changed, std::uint16_t price_before) const;

  Cell goal_;
  int width_ = 0;
  int height_ = 0;
  // The search, which goes on when it is asked for more.
  mutable std::vector<Part> parts_;
  mutable std::vector<std::uint32_t> searched_parts_;  ///< in order
  mutable std::int32_t searched_ = 0;                  ///< all that cost less
  mutable std::vector<std::vector<std::uint32_t>> buckets_;
  mutable std::size_t waiting_ = 0;
};

}  // namespace cmn
