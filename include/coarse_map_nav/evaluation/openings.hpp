// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Holes in the walls of a house: doors, passages, windows.
#pragma once

#include "coarse_map_nav/evaluation/house.hpp"

#include <optional>
#include <random>
#include <vector>

namespace cmn {

/// The space between two rooms that face each other across a wall, or nothing.
std::optional<Rectangle> wall_between(const Rectangle& a, const Rectangle& b);

/// Where a window or a door onto the open could be: the wall beside a room.
struct OuterWall {
  Rectangle area;  ///< as thick as the wall, as long as the room
  int side = 0;    ///< 0 east, 1 north, 2 west, 3 south of the room
};
/// The sides of a room along which the outside lies, over their whole length.
std::vector<OuterWall> outer_walls(const House& house, int room, double thickness);

/// A door in the wall between two rooms, most often beside a corner, which leaves the wall to the
/// furniture. False when they share no wall that is long enough.
bool add_door(House& house, std::mt19937_64& rng, int room, int other, double width);
/// A wider hole without a door.
bool add_passage(House& house, std::mt19937_64& rng, int room, int other, double narrowest,
                 double widest);
/// The door of the house, in the shortest outer wall of a hall. False when there is none.
bool add_entrance(House& house, int hall, double outer_wall_m);
/// One in each outer wall of a room that people live in; a small one in a bath.
void add_windows(House& house, std::mt19937_64& rng, double outer_wall_m);

/// The outline less notches, rooms and openings, as blocks; with lintels and sills.
std::vector<Wall> wall_blocks(const House& house);

}  // namespace cmn
