// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/floor_plan.hpp"

#include "coarse_map_nav/evaluation/openings.hpp"
#include "coarse_map_nav/evaluation/plan_draws.hpp"
#include "coarse_map_nav/evaluation/room_programme.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace cmn {
namespace {

/// A plan in the making; its hall runs from west to east until the whole is turned at the end.
class Draughtsman {
 public:
  Draughtsman(std::mt19937_64& rng, const HouseParams& params)
      : rng_{rng},
        params_{params},
        outer_{snapped(params.outer_wall_m)},
        inner_{snapped(params.inner_wall_m)} {}

  /// Tries once; none when the draws do not fit together.
  std::optional<House> draw(double area_m2);

 private:
  bool draw_flat(const Programme& programme);
  bool draw_spine(Programme programme);
  bool lay_row(const Group& row, double x0, double x1, double y0, double y1,
               const std::vector<int>& halls);
  bool lay_living(const Programme& programme, const Rectangle& area, double hall_y0,
                  double hall_y1);
  int add_room(RoomPurpose purpose, const Rectangle& area);
  bool add_door(int room, int other) {
    const double width = draw_snapped(rng_, params_.narrowest_door_m, params_.widest_door_m);
    return cmn::add_door(house_, rng_, room, other, width);
  }
  bool add_passage(int room, int other, double narrowest, double widest) {
    return cmn::add_passage(house_, rng_, room, other, narrowest, widest);
  }

  std::mt19937_64& rng_;
  const HouseParams& params_;
  double outer_, inner_;
  House house_;
};

int Draughtsman::add_room(RoomPurpose purpose, const Rectangle& area) {
  house_.rooms.push_back({purpose, area});
  return static_cast<int>(house_.rooms.size()) - 1;
}

/// The living room with its kitchen, across the end of the hall.
bool Draughtsman::lay_living(const Programme& programme, const Rectangle& area, double hall_y0,
                             double hall_y1) {
  const bool is_open = programme.has_open_kitchen;
  const double wall = is_open ? 0.0 : inner_;
  const double depth = snapped(programme.kitchen.area_m2 / area.width());
  // The kitchen goes to where the hall leaves more room.
  const bool is_north = area.y1 - hall_y1 > hall_y0 - area.y0;
  Rectangle living = area;
  Rectangle kitchen = area;
  if (is_north) {
    kitchen.y0 = area.y1 - depth;
    living.y1 = kitchen.y0 - wall;
  } else {
    kitchen.y1 = area.y0 + depth;
    living.y0 = kitchen.y1 + wall;
  }
  if (!is_sound(programme.living, living.width(), living.height()) ||
      !is_sound(programme.kitchen, kitchen.width(), kitchen.height())) {
    return false;
  }
  const int living_room = add_room(RoomPurpose::kLiving, living);
  const int kitchen_room = add_room(RoomPurpose::kKitchen, kitchen);
  return is_open || (draw_chance(rng_, 0.5) ? add_door(kitchen_room, living_room)
                                            : add_passage(kitchen_room, living_room, 1.0, 1.6));
}

/// Rooms side by side along the hall, each with its door.
bool Draughtsman::lay_row(const Group& row, double x0, double x1, double y0, double y1,
                          const std::vector<int>& halls) {
  const double depth = y1 - y0;
  double walls = 0.0;
  for (std::size_t i = 0; i + 1 < row.size(); ++i) {
    walls += row[i].is_open_to_next ? 0.0 : inner_;
  }
  const double stretch = (x1 - x0 - walls) / (area_of(row) / depth);
  if (row.empty() || stretch < 0.85 || stretch > 1.2) {
    return false;
  }
  double x = x0;
  int previous = -1;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const Slot& slot = row[i];
    const bool is_last = i + 1 == row.size();
    const double end = is_last ? x1 : x + snapped(stretch * slot.area_m2 / depth);
    if (!is_sound(slot, end - x, depth)) {
      return false;
    }
    if (!slot.is_outside) {
      const int room = add_room(slot.purpose, {x, y0, end, y1});
      bool is_joined = i > 0 && row[i - 1].is_open_to_next;
      if (slot.is_behind_previous) {
        is_joined = add_door(room, previous);
      } else if (slot.is_entrance) {
        is_joined = add_passage(room, halls.front(), end - x, end - x);
      }
      for (std::size_t h = 0; !is_joined && h < halls.size(); ++h) {
        is_joined = slot.purpose == RoomPurpose::kLiving && draw_chance(rng_, 0.6)
                        ? add_passage(room, halls[h], 1.0, 1.6)
                        : add_door(room, halls[h]);
      }
      if (!is_joined) {
        return false;
      }
      previous = room;
    } else {
      const bool is_south = y0 < outer_ + 1e-9;
      house_.notches.push_back({x - inner_ + outer_, is_south ? 0.0 : y0 - inner_ + outer_,
                                x1 + outer_, is_south ? y1 + inner_ - outer_ : y1 + outer_});
    }
    x = end + (slot.is_open_to_next ? 0.0 : inner_);
  }
  return true;
}

/// Rooms on both sides of a hall, or on one.
bool Draughtsman::draw_spine(Programme programme) {
  const bool has_block = draw_chance(rng_, 0.65);
  const bool is_two_sided = programme.area_m2 > 70.0 || !has_block;
  const bool has_end_bath = is_two_sided && draw_chance(rng_, 0.35);
  const bool has_vestibule = (has_end_bath && has_block) || draw_chance(rng_, 0.4);
  const double hall = has_end_bath ? draw_snapped(rng_, 1.75, 2.1) : draw_snapped(rng_, 1.1, 1.5);

  // Share the groups out so that both rows become about as long.
  std::vector<Group> groups = programme.groups;
  Slot bath;
  if (has_end_bath) {
    const auto found = std::find_if(groups.begin(), groups.end(), [](const Group& group) {
      return group.front().purpose == RoomPurpose::kBath;
    });
    bath = found->front();
    groups.erase(found);
  }
  if (!has_block) {
    Slot living = programme.living;
    living.is_open_to_next = programme.has_open_kitchen;
    groups.insert(groups.begin(), Group{living, programme.kitchen});
    if (draw_chance(rng_, 0.5)) {
      std::swap(groups.front()[0], groups.front()[1]);
      groups.front()[0].is_open_to_next = programme.has_open_kitchen;
      groups.front()[1].is_open_to_next = false;
    }
  }
  if (has_vestibule) {
    Slot entrance{RoomPurpose::kHall, draw_between(rng_, 4.5, 6.0)};
    entrance.is_entrance = true;
    groups.push_back({entrance});
  }
  std::vector<Group> rows(is_two_sided ? 2 : 1);
  std::vector<double> depths;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    depths.push_back(
        draw_snapped(rng_, i == 0 && !has_block ? 3.7 : 3.0, i == 0 && !has_block ? 4.6 : 4.1));
  }
  for (const Group& group : groups) {
    const std::size_t shorter =
        rows.size() == 2 && area_of(rows[1]) / depths[1] < area_of(rows[0]) / depths[0] ? 1 : 0;
    const bool at_front = draw_chance(rng_, 0.5);
    rows[shorter].insert(at_front ? rows[shorter].begin() : rows[shorter].end(), group.begin(),
                         group.end());
  }
  double length = 0.0;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    lengths.push_back(area_of(rows[i]) / depths[i] +
                      inner_ * (static_cast<double>(rows[i].size()) - 1.0));
    length += lengths.back() / static_cast<double>(rows.size());
  }
  if (is_two_sided && std::abs(lengths[0] - lengths[1]) > 1.5 && draw_chance(rng_, 0.8)) {
    // An L: the shorter row leaves a notch at the far end of the outline.
    const std::size_t shorter = lengths[0] < lengths[1] ? 0 : 1;
    length = std::max(lengths[0], lengths[1]);
    Slot notch;
    notch.is_outside = true;
    notch.area_m2 = (length - lengths[shorter]) * depths[shorter];
    rows[shorter].push_back(notch);
  }
  length = snapped(length);

  const double south = is_two_sided ? depths[0] + inner_ : 0.0;
  const double north = depths.back() + inner_;
  const double height = south + hall + north;
  const double hall_y0 = outer_ + south;
  const double block =
      has_block ? snapped((programme.living.area_m2 + programme.kitchen.area_m2) / height) : 0.0;
  const double x0 = outer_ + (has_block ? block + inner_ : 0.0);
  const double end_bath = has_end_bath ? snapped(bath.area_m2 / hall) : 0.0;
  const double x1 = x0 + length;
  house_.outline = {0.0, 0.0, x1 + outer_, height + 2.0 * outer_};
  const Rectangle corridor{x0, hall_y0, x1 - (has_end_bath ? end_bath + inner_ : 0.0),
                           hall_y0 + hall};
  if (corridor.width() < 2.0) {
    return false;
  }
  const int hall_room = add_room(RoomPurpose::kHall, corridor);
  if (has_end_bath) {
    if (!is_sound(bath, end_bath, hall)) {
      return false;
    }
    const int room =
        add_room(RoomPurpose::kBath, {corridor.x1 + inner_, hall_y0, x1, hall_y0 + hall});
    if (!add_door(room, hall_room)) {
      return false;
    }
  }
  if (is_two_sided && !lay_row(rows[0], x0, x1, outer_, outer_ + depths[0], {hall_room})) {
    return false;
  }
  if (!lay_row(rows.back(), x0, x1, hall_y0 + hall + inner_, hall_y0 + hall + north, {hall_room})) {
    return false;
  }
  if (has_block) {
    const auto living = static_cast<int>(house_.rooms.size());
    if (!lay_living(programme, {outer_, outer_, outer_ + block, outer_ + height}, hall_y0,
                    hall_y0 + hall) ||
        !(draw_chance(rng_, 0.6)
              ? add_passage(living, hall_room, 0.95, 1.2)
              : cmn::add_door(house_, rng_, living, hall_room, params_.widest_door_m))) {
      return false;
    }
  }
  int entrance_hall = hall_room;
  for (std::size_t r = 0; r < house_.rooms.size(); ++r) {
    if (house_.rooms[r].purpose == RoomPurpose::kHall) {
      entrance_hall = static_cast<int>(r);  // the vestibule comes after the corridor
    }
  }
  return add_entrance(house_, entrance_hall, outer_);
}

/// A small flat: living room and kitchen on one side; hall, bath and bedroom on the other.
bool Draughtsman::draw_flat(const Programme& programme) {
  const double height = draw_snapped(rng_, 5.4, 6.8);
  const double left = snapped((programme.living.area_m2 + programme.kitchen.area_m2) / height);
  const double right = draw_snapped(rng_, 3.1, 4.0);
  const double lower = draw_snapped(rng_, 1.9, 2.6);
  const double hall = draw_snapped(rng_, 1.15, 1.6);
  const double x0 = outer_ + left + inner_;
  house_.outline = {0.0, 0.0, x0 + right + outer_, height + 2.0 * outer_};
  const int hall_room = add_room(RoomPurpose::kHall, {x0, outer_, x0 + hall, outer_ + lower});
  const Rectangle bath{x0 + hall + inner_, outer_, x0 + right, outer_ + lower};
  const Rectangle bedroom{x0, outer_ + lower + inner_, x0 + right, outer_ + height};
  if (!is_sound({RoomPurpose::kBath}, bath.width(), bath.height()) ||
      !is_sound({RoomPurpose::kBedroom}, bedroom.width(), bedroom.height())) {
    return false;
  }
  const int bath_room = add_room(RoomPurpose::kBath, bath);
  const int bedroom_room = add_room(RoomPurpose::kBedroom, bedroom);
  const auto living = static_cast<int>(house_.rooms.size());
  return lay_living(programme, {outer_, outer_, outer_ + left, outer_ + height}, outer_,
                    outer_ + lower) &&
         add_door(bath_room, hall_room) && add_door(bedroom_room, hall_room) &&
         cmn::add_door(house_, rng_, living, hall_room, params_.widest_door_m) &&
         add_entrance(house_, hall_room, outer_);
}

std::optional<House> Draughtsman::draw(double area_m2) {
  const Programme programme = draw_programme(rng_, area_m2);
  const bool is_flat =
      programme.area_m2 < 52.0 || (programme.area_m2 < 62.0 && draw_chance(rng_, 0.5));
  if (!(is_flat ? draw_flat(programme) : draw_spine(programme))) {
    return std::nullopt;
  }
  // About as large as meant, so that all sizes are equally frequent.
  const double area = house_.area_m2();
  if (area < params_.smallest_m2 || area > params_.largest_m2 ||
      std::abs(area - programme.area_m2) > 0.08 * programme.area_m2) {
    return std::nullopt;
  }
  add_windows(house_, rng_, outer_);
  return house_;
}

/// Mirrored from left to right, from top to bottom, and across the diagonal.
void turn(House& house, bool flip_x, bool flip_y, bool swap) {
  const Rectangle outline = house.outline;
  const auto turned_area = [&](Rectangle a) {
    if (flip_x) {
      a = {outline.x1 - a.x1, a.y0, outline.x1 - a.x0, a.y1};
    }
    if (flip_y) {
      a = {a.x0, outline.y1 - a.y1, a.x1, outline.y1 - a.y0};
    }
    return swap ? Rectangle{a.y0, a.x0, a.y1, a.x1} : a;
  };
  house.outline = turned_area(outline);
  for (Rectangle& notch : house.notches) {
    notch = turned_area(notch);
  }
  for (Room& room : house.rooms) {
    room.area = turned_area(room.area);
  }
  for (Opening& opening : house.openings) {
    opening.area = turned_area(opening.area);
  }
}

}  // namespace

House draw_floor_plan(std::mt19937_64& rng, const HouseParams& params) {
  constexpr int kAreas = 100;
  constexpr int kAttempts = 1000;
  for (int i = 0; i < kAreas; ++i) {
    const double area_m2 = draw_between(rng, params.smallest_m2, params.largest_m2);
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      std::optional<House> house = Draughtsman{rng, params}.draw(area_m2);
      if (house) {
        const bool flip_x = draw_chance(rng, 0.5);
        const bool flip_y = draw_chance(rng, 0.5);
        turn(*house, flip_x, flip_y, draw_chance(rng, 0.5));
        house->walls = wall_blocks(*house);
        return *house;
      }
    }
  }
  throw std::invalid_argument(
      "no floor plan fits these parameters of a house; more room between smallest_m2 and "
      "largest_m2, or narrower doors, may help");
}

}  // namespace cmn
