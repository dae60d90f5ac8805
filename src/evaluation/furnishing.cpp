// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/furnishing.hpp"

#include "coarse_map_nav/evaluation/interior.hpp"
#include "coarse_map_nav/evaluation/plan_draws.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace cmn {
namespace {

constexpr Preference kCorner = Preference::kCorner;
constexpr Preference kMiddle = Preference::kMiddle;

// Each returns how many of the pieces that make the room what it is found no place.

int furnish_living(Interior& room, bool has_dining_room) {
  const double area = room.layout().area().area();
  const bool has_sofa = room.place_sofa_and_television();
  if (!has_dining_room && area > 15.0) {
    const bool has_heads = draw_chance(room.rng(), 0.3);
    room.place_dining_set(area > 21.0 ? 3 : 2, has_heads) || room.place_dining_set(2, false) ||
        room.place_dining_set(1, false);
  }
  if (room.chance(0.8)) {
    const double width = draw_snapped(room.rng(), 0.8, 1.8);
    room.place_block("bookshelf", against_wall(width, 0.32, 0.5, kCorner, true), 2.0);
  }
  if (room.chance(0.6)) {
    const double width = draw_snapped(room.rng(), 1.2, 1.8);
    room.place_block("sideboard", against_wall(width, 0.45, 0.6, kMiddle), 0.8);
  }
  if (room.chance(0.5)) {
    room.place_block("bookshelf", against_wall(0.8, 0.32, 0.5, Preference::kAnywhere, true), 2.0);
  }
  for (int i = 0; i < 2; ++i) {
    if (room.chance(0.6)) {
      room.place_plant();
    }
  }
  return !has_sofa;
}

int furnish_kitchen(Interior& room, bool has_dining_room) {
  const double area = room.layout().area().area();
  const bool has_counter = room.place_kitchen_counter();
  if (area > 9.0 && room.chance(has_dining_room ? 0.4 : 0.7)) {
    room.place_dining_set(area > 12.0 ? 2 : 1, false);
  }
  if (room.chance(0.4)) {
    const double width = draw_snapped(room.rng(), 0.6, 1.0);
    room.place_block("cupboard", against_wall(width, 0.4, 0.5, kCorner, true), 1.9);
  }
  return !has_counter;
}

int furnish_dining(Interior& room) {
  const bool has_table =
      room.place_dining_set(3, draw_chance(room.rng(), 0.6)) || room.place_dining_set(2, false);
  const double width = draw_snapped(room.rng(), 1.2, 1.8);
  room.place_block("sideboard", against_wall(width, 0.45, 0.5, kMiddle), 0.85);
  if (room.chance(0.5)) {
    room.place_block("cabinet", against_wall(0.9, 0.4, 0.5, kCorner, true), 1.9);
  }
  return !has_table;
}

int furnish_bedroom(Interior& room) {
  const bool is_for_two = room.layout().area().area() > 10.5;
  const bool has_bed =
      (is_for_two && room.place_double_bed(draw_chance(room.rng(), 0.5) ? 1.6 : 1.8)) ||
      (draw_chance(room.rng(), 0.4) && room.place_double_bed(1.4)) ||
      room.place_single_bed(draw_chance(room.rng(), 0.7) ? 0.9 : 1.2);
  bool has_wardrobe = false;
  double width = draw_snapped(room.rng(), is_for_two ? 1.8 : 1.2, is_for_two ? 2.6 : 1.8);
  for (; width > 0.75 && !has_wardrobe; width -= 0.3) {
    has_wardrobe = room.place_block("wardrobe", against_wall(width, 0.6, 0.6, kCorner, true), 2.1);
  }
  if (room.chance(is_for_two ? 0.35 : 0.8)) {
    room.place_desk_and_chair();
  }
  if (room.chance(0.5)) {
    const double dresser = draw_snapped(room.rng(), 0.8, 1.2);
    room.place_block("dresser", against_wall(dresser, 0.45, 0.55), 0.85);
  }
  if (room.chance(0.35)) {
    room.place_block("shelf", against_wall(0.8, 0.3, 0.4, kCorner, true), 1.8);
  }
  return !has_bed + !has_wardrobe;
}

int furnish_bath(Interior& room) {
  const bool has_tub = room.layout().area().area() > 4.6 && draw_chance(room.rng(), 0.65) &&
                       room.place_block("bathtub", against_wall(1.65, 0.75, 0.5, kCorner), 0.55);
  const bool has_shower =
      !has_tub && (room.place_block("shower", against_wall(0.9, 0.9, 0.5, kCorner), 2.0) ||
                   room.place_block("shower", against_wall(0.8, 0.8, 0.5, kCorner), 2.0));
  const bool has_toilet = room.place_toilet();
  const double width = draw_snapped(room.rng(), 0.55, 0.8);
  const bool has_basin = room.place_block("basin", against_wall(width, 0.46, 0.55), 0.85) ||
                         room.place_block("basin", against_wall(0.5, 0.4, 0.5), 0.85);
  if (room.chance(0.6)) {
    room.place_block("washing machine", against_wall(0.6, 0.6, 0.5, kCorner), 0.85);
  }
  if (room.chance(0.3)) {
    room.place_block("cabinet", against_wall(0.4, 0.35, 0.45, kCorner, true), 1.7);
  }
  return !(has_tub || has_shower) + !has_toilet + !has_basin;
}

int furnish_office(Interior& room) {
  const bool has_desk = room.place_desk_and_chair();
  for (int i = 0; i < 3; ++i) {
    if (room.chance(0.7)) {
      const double width = draw_snapped(room.rng(), 0.8, 1.2);
      room.place_block("bookshelf", against_wall(width, 0.32, 0.5, kCorner, true), 2.0);
    }
  }
  if (room.chance(0.4)) {
    room.place_small_sofa();
  }
  return !has_desk;
}

int furnish_storage(Interior& room) {
  int shelves = 0;
  for (int i = 0; i < 2; ++i) {
    const double width = draw_snapped(room.rng(), 1.2, 2.2);
    shelves += room.place_block("shelf", against_wall(width, 0.4, 0.6, kCorner), 2.0);
  }
  if (room.chance(0.6)) {
    room.place_block("washing machine", against_wall(0.6, 0.6, 0.5, kCorner), 0.85);
  }
  return shelves == 0;
}

int furnish_hall(Interior& room) {
  const double breadth = std::min(room.layout().area().width(), room.layout().area().height());
  if (breadth < 1.25) {
    return 0;
  }
  if (room.chance(0.8)) {
    const double width = draw_snapped(room.rng(), 0.6, 1.1);
    room.place_block("shoe cabinet", against_wall(width, breadth > 1.6 ? 0.4 : 0.3, 0.5), 1.0);
  }
  if (breadth > 1.5 && room.chance(0.5)) {
    const double width = draw_snapped(room.rng(), 0.8, 1.2);
    room.place_block("coats", against_wall(width, 0.4, 0.5, kCorner, true), 1.9);
  }
  return 0;
}

int furnish(Interior& room, RoomPurpose purpose, bool has_dining_room) {
  switch (purpose) {
    case RoomPurpose::kLiving:
      return furnish_living(room, has_dining_room);
    case RoomPurpose::kKitchen:
      return furnish_kitchen(room, has_dining_room);
    case RoomPurpose::kDining:
      return furnish_dining(room);
    case RoomPurpose::kBedroom:
      return furnish_bedroom(room);
    case RoomPurpose::kBath:
      return furnish_bath(room);
    case RoomPurpose::kOffice:
      return furnish_office(room);
    case RoomPurpose::kStorage:
      return furnish_storage(room);
    case RoomPurpose::kHall:
      return furnish_hall(room);
  }
  return 0;
}

}  // namespace

void furnish(House& house, std::mt19937_64& rng, const HouseParams& params) {
  constexpr int kAttempts = 12;
  constexpr double kWalkableShare = 0.8;
  const bool has_dining_room =
      std::any_of(house.rooms.begin(), house.rooms.end(),
                  [](const Room& room) { return room.purpose == RoomPurpose::kDining; });
  for (std::size_t i = 0; i < house.rooms.size(); ++i) {
    std::vector<Furniture> best;
    int fewest = std::numeric_limits<int>::max();
    for (int attempt = 0; attempt < kAttempts && fewest > 0; ++attempt) {
      Interior room{house, static_cast<int>(i), rng, params};
      const int lacking = furnish(room, house.rooms[i].purpose, has_dining_room) +
                          (room.layout().walkable_share() < kWalkableShare ? 1 : 0);
      if (lacking < fewest) {
        fewest = lacking;
        best = room.pieces();
      }
    }
    house.furniture.insert(house.furniture.end(), best.begin(), best.end());
  }
}

}  // namespace cmn
