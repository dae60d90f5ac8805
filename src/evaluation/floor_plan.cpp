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
  bool lay_flat(const Programme& programme);
  /// A hall with a row of rooms on one or both sides.
  struct Spine {
    bool has_block = false;  ///< the living room lies across its western end
    double hall = 1.2;       ///< [m] breadth
    std::optional<Slot> end_bath;
    std::vector<Group> rows;  ///< from the south
    std::vector<double> depths;
    double length = 0.0;
  };
  Spine draw_spine(const Programme& programme);
  void share_out(const std::vector<Group>& groups, Spine& spine);
  bool lay_spine(const Programme& programme);
  bool lay_row(const Group& row, double x0, double x1, double y0, double y1, int hall);
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
bool Draughtsman::lay_row(const Group& row, double x0, double x1, double y0, double y1, int hall) {
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
        is_joined = add_passage(room, hall, end - x, end - x);
      }
      if (!is_joined) {
        is_joined = slot.purpose == RoomPurpose::kLiving && draw_chance(rng_, 0.6)
                        ? add_passage(room, hall, 1.0, 1.6)
                        : add_door(room, hall);
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

/// Shares the rooms out between the two sides of the hall so that both become about as long.
void Draughtsman::share_out(const std::vector<Group>& groups, Spine& spine) {
  const auto length_of = [&](std::size_t row) {
    return area_of(spine.rows[row]) / spine.depths[row];
  };
  for (const Group& group : groups) {
    Group& row = spine.rows[spine.rows.size() == 2 && length_of(1) < length_of(0) ? 1 : 0];
    const bool at_front = draw_chance(rng_, 0.5);
    row.insert(at_front ? row.begin() : row.end(), group.begin(), group.end());
  }
  std::vector<double> lengths;
  for (std::size_t i = 0; i < spine.rows.size(); ++i) {
    lengths.push_back(length_of(i) + inner_ * (static_cast<double>(spine.rows[i].size()) - 1.0));
    spine.length += lengths.back() / static_cast<double>(spine.rows.size());
  }
  if (lengths.size() == 2 && std::abs(lengths[0] - lengths[1]) > 1.5 && draw_chance(rng_, 0.8)) {
    // An L: the shorter row leaves a notch at the far end of the outline.
    const std::size_t shorter = lengths[0] < lengths[1] ? 0 : 1;
    spine.length = std::max(lengths[0], lengths[1]);
    Slot notch;
    notch.is_outside = true;
    notch.area_m2 = (spine.length - lengths[shorter]) * spine.depths[shorter];
    spine.rows[shorter].push_back(notch);
  }
  spine.length = snapped(spine.length);
}

Draughtsman::Spine Draughtsman::draw_spine(const Programme& programme) {
  Spine spine;
  spine.has_block = draw_chance(rng_, 0.65);
  const bool is_two_sided = programme.area_m2 > 70.0 || !spine.has_block;
  const bool has_end_bath = is_two_sided && draw_chance(rng_, 0.35);
  const bool has_vestibule = (has_end_bath && spine.has_block) || draw_chance(rng_, 0.4);
  spine.hall = has_end_bath ? draw_snapped(rng_, 1.75, 2.1) : draw_snapped(rng_, 1.1, 1.5);
  std::vector<Group> groups = programme.groups;
  if (has_end_bath) {
    const auto bath = std::find_if(groups.begin(), groups.end(), [](const Group& group) {
      return group.front().purpose == RoomPurpose::kBath;
    });
    spine.end_bath = bath->front();
    groups.erase(bath);
  }
  if (!spine.has_block) {
    const bool is_living_first = !draw_chance(rng_, 0.5);
    Group day{is_living_first ? programme.living : programme.kitchen,
              is_living_first ? programme.kitchen : programme.living};
    day.front().is_open_to_next = programme.has_open_kitchen;
    groups.insert(groups.begin(), day);
  }
  if (has_vestibule) {
    Slot entrance{RoomPurpose::kHall, draw_between(rng_, 4.5, 6.0)};
    entrance.is_entrance = true;
    groups.push_back({entrance});
  }
  spine.rows.resize(is_two_sided ? 2 : 1);
  for (std::size_t i = 0; i < spine.rows.size(); ++i) {
    const bool has_living = i == 0 && !spine.has_block;
    spine.depths.push_back(draw_snapped(rng_, has_living ? 3.7 : 3.0, has_living ? 4.6 : 4.1));
  }
  share_out(groups, spine);
  return spine;
}

/// Rooms on both sides of a hall, or on one.
bool Draughtsman::lay_spine(const Programme& programme) {
  const Spine spine = draw_spine(programme);
  const bool is_two_sided = spine.rows.size() == 2;
  const double south = is_two_sided ? spine.depths[0] + inner_ : 0.0;
  const double north = spine.depths.back() + inner_;
  const double height = south + spine.hall + north;
  const double hall_y0 = outer_ + south;
  const double hall_y1 = hall_y0 + spine.hall;
  const double block = snapped((programme.living.area_m2 + programme.kitchen.area_m2) / height);
  const double x0 = outer_ + (spine.has_block ? block + inner_ : 0.0);
  const double x1 = x0 + spine.length;
  house_.outline = {0.0, 0.0, x1 + outer_, height + 2.0 * outer_};
  double hall_x1 = x1;
  if (spine.end_bath) {
    const double width = snapped(spine.end_bath->area_m2 / spine.hall);
    hall_x1 -= width + inner_;
    if (!is_sound(*spine.end_bath, width, spine.hall)) {
      return false;
    }
  }
  if (hall_x1 - x0 < 2.0) {
    return false;
  }
  const int hall = add_room(RoomPurpose::kHall, {x0, hall_y0, hall_x1, hall_y1});
  if (spine.end_bath &&
      !add_door(add_room(RoomPurpose::kBath, {hall_x1 + inner_, hall_y0, x1, hall_y1}), hall)) {
    return false;
  }
  if ((is_two_sided && !lay_row(spine.rows[0], x0, x1, outer_, outer_ + spine.depths[0], hall)) ||
      !lay_row(spine.rows.back(), x0, x1, hall_y1 + inner_, hall_y0 + spine.hall + north, hall)) {
    return false;
  }
  if (spine.has_block) {
    const auto living = static_cast<int>(house_.rooms.size());
    if (!lay_living(programme, {outer_, outer_, outer_ + block, outer_ + height}, hall_y0,
                    hall_y1) ||
        !(draw_chance(rng_, 0.6)
              ? add_passage(living, hall, 0.95, 1.2)
              : cmn::add_door(house_, rng_, living, hall, params_.widest_door_m))) {
      return false;
    }
  }
  int entrance_hall = hall;
  for (std::size_t r = 0; r < house_.rooms.size(); ++r) {
    if (house_.rooms[r].purpose == RoomPurpose::kHall) {
      entrance_hall = static_cast<int>(r);  // the vestibule comes after the corridor
    }
  }
  return add_entrance(house_, entrance_hall, outer_);
}

/// A small flat: living room and kitchen on one side; hall, bath and bedroom on the other.
bool Draughtsman::lay_flat(const Programme& programme) {
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
  if (!(is_flat ? lay_flat(programme) : lay_spine(programme))) {
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
