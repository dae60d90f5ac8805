// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Which rooms a home has, before anybody knows where.
#pragma once

#include "coarse_map_nav/evaluation/house.hpp"

#include <random>
#include <vector>

namespace cmn {

/// A room in a row of rooms.
struct Slot {
  RoomPurpose purpose = RoomPurpose::kBedroom;
  double area_m2 = 10.0;
  bool is_open_to_next = false;     ///< no wall in between
  bool is_behind_previous = false;  ///< its door is in the previous room: a bath of one's own
  bool is_entrance = false;         ///< part of the hall
  bool is_outside = false;          ///< a notch in the outline
};
/// Slots that stay together.
using Group = std::vector<Slot>;

/// What is known of a home before it is laid out.
struct Programme {
  double area_m2 = 0.0;
  Slot living, kitchen;
  bool has_open_kitchen = false;
  std::vector<Group> groups;  ///< all other rooms
};

/// Draws one for a home of a floor area; the rooms share it out among themselves.
Programme draw_programme(std::mt19937_64& rng, double area_m2);

/// Whether a room of the purpose can be of that shape.
bool is_sound(const Slot& slot, double width, double depth);
/// [m2] of all slots.
double area_of(const Group& row);

}  // namespace cmn
