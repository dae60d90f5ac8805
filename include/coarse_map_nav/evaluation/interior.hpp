// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A room and the groups of furniture that belong together in it.
#pragma once

#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/evaluation/house.hpp"
#include "coarse_map_nav/evaluation/house_generator.hpp"
#include "coarse_map_nav/evaluation/room_layout.hpp"

#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace cmn {

/// One room while it is being furnished. What finds no place leaves all as it was: `false`.
class Interior {
 public:
  Interior(const House& house, int room, std::mt19937_64& rng, const HouseParams& params)
      : rng_{rng}, params_{params}, layout_{house, room, params.way_m} {}

  /// A solid piece with its back to the wall.
  bool place_block(const std::string& name, const AtWall& piece, double height);
  /// The television at a wall, the sofa before it, a low table between, armchairs beside.
  bool place_sofa_and_television();
  /// Its head at a wall, with a way on both sides or at least on one, and nightstands.
  bool place_double_bed(double width);
  /// Along the wall, for one.
  bool place_single_bed(double width);
  /// A table with chairs on its long sides and perhaps at its ends, free-standing.
  bool place_dining_set(int chairs_a_side, bool has_head_chairs);
  bool place_desk_and_chair();
  bool place_toilet();
  bool place_small_sofa();
  bool place_plant();
  /// Fridge, counter, sink and stove in one run along the wall; in an L where that is short.
  bool place_kitchen_counter();

  const RoomLayout& layout() const { return layout_; }
  const std::vector<Furniture>& pieces() const { return pieces_; }
  std::mt19937_64& rng() { return rng_; }
  /// Whether a piece is there that a home could do without.
  bool chance(double p) { return draw_uniform(rng_) < p * params_.clutter / kUsualClutter; }

 private:
  static constexpr double kUsualClutter = 0.7;

  /// A television and the sofa that faces it.
  struct SofaGroup {
    Side side = Side::kSouth;  ///< of the wall behind the television
    Pose2 T_house_foot;        ///< at that wall, x into the room
    double sofa_m = 2.0;
    double stand_m = 1.5;
    double distance_m = 2.5;  ///< from the wall to the front of the sofa
  };
  std::optional<SofaGroup> draw_sofa_group(double longest_sofa_m);
  bool place(const SofaGroup& group);
  void put_chairs(const Pose2& T_house_table, double depth, double length, int chairs_a_side,
                  bool has_head_chairs);
  /// Takes the longest wall that leaves the ways free; returns its length there, or 0.
  double place_counter_run(double longest_m, double shortest_m, bool is_first);
  void put_kitchen(const Pose2& T_house_run, double sign, int units, bool is_first,
                   bool has_window);

  void put(Furniture piece) {
    piece.room = layout_.room();
    pieces_.push_back(std::move(piece));
  }

  std::mt19937_64& rng_;
  const HouseParams& params_;
  RoomLayout layout_;
  std::vector<Furniture> pieces_;
};

}  // namespace cmn
