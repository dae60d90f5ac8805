// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/room_programme.hpp"

#include "coarse_map_nav/evaluation/plan_draws.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace cmn {
namespace {

/// The narrowest that a room of the purpose can be [m].
double least_width(const Slot& slot) {
  if (slot.is_outside) {
    return 1.2;
  }
  switch (slot.purpose) {
    case RoomPurpose::kLiving:
      return 3.3;
    case RoomPurpose::kKitchen:
      return 1.9;
    case RoomPurpose::kDining:
      return 2.6;
    case RoomPurpose::kBedroom:
      return 2.55;
    case RoomPurpose::kBath:
      return 1.65;
    case RoomPurpose::kOffice:
      return 2.2;
    case RoomPurpose::kStorage:
      return 1.2;
    case RoomPurpose::kHall:
      return 1.1;
  }
  return 0.0;
}

}  // namespace

bool is_sound(const Slot& slot, double width, double depth) {
  if (std::min(width, depth) < least_width(slot) - 1e-9) {
    return false;
  }
  const bool is_any_shape = slot.is_outside || slot.purpose == RoomPurpose::kHall;
  const double longest = slot.purpose == RoomPurpose::kStorage ? 3.2 : 2.2;
  return is_any_shape || std::max(width, depth) <= longest * std::min(width, depth);
}

Programme draw_programme(std::mt19937_64& rng, double area_m2) {
  Programme programme;
  const double area = area_m2;
  programme.area_m2 = area_m2;
  const bool is_large = area > 95.0;
  const int bedrooms = 1 + (area > 60.0 && draw_chance(rng, 0.75)) + (area > 85.0) +
                       (area > 120.0 && draw_chance(rng, 0.6));
  programme.living = {RoomPurpose::kLiving, draw_between(rng, 15.0, 20.0) + 0.08 * area};
  programme.kitchen = {RoomPurpose::kKitchen, draw_between(rng, 6.5, 9.0) + 0.03 * area};
  programme.has_open_kitchen = draw_chance(rng, area < 70.0 ? 0.7 : 0.45);
  bool has_own_bath = is_large && draw_chance(rng, 0.6);
  for (int i = 0; i < bedrooms; ++i) {
    Group group{{RoomPurpose::kBedroom,
                 i == 0 ? draw_between(rng, 12.0, 16.5) : draw_between(rng, 8.5, 12.5)}};
    if (i == 0 && has_own_bath) {
      group.push_back({RoomPurpose::kBath, draw_between(rng, 5.0, 6.5)});
      group.back().is_behind_previous = true;
    }
    programme.groups.push_back(group);
  }
  programme.groups.push_back({{RoomPurpose::kBath, draw_between(rng, 4.8, 7.5)}});
  if (is_large && !has_own_bath && draw_chance(rng, 0.5)) {
    programme.groups.push_back({{RoomPurpose::kBath, draw_between(rng, 4.5, 5.5)}});
  }
  if (area > 75.0 && draw_chance(rng, 0.5)) {
    programme.groups.push_back({{RoomPurpose::kOffice, draw_between(rng, 7.0, 10.5)}});
  }
  if (area > 105.0 && draw_chance(rng, 0.6)) {
    programme.groups.push_back({{RoomPurpose::kDining, draw_between(rng, 10.0, 13.5)}});
  }
  if (area > 65.0 && draw_chance(rng, 0.4)) {
    programme.groups.push_back({{RoomPurpose::kStorage, draw_between(rng, 3.8, 5.5)}});
  }
  // Halls and what does not come out even take about an eighth.
  double sum = programme.living.area_m2 + programme.kitchen.area_m2;
  for (const Group& group : programme.groups) {
    sum += area_of(group);
  }
  const double factor = std::clamp(0.87 * area / sum, 0.8, 1.3);
  programme.living.area_m2 *= factor;
  programme.kitchen.area_m2 *= factor;
  for (Group& group : programme.groups) {
    for (Slot& slot : group) {
      slot.area_m2 *= factor;
    }
  }
  for (std::size_t i = programme.groups.size(); i > 1; --i) {
    std::swap(programme.groups[i - 1], programme.groups[draw_index(rng, i)]);
  }
  return programme;
}

double area_of(const Group& row) {
  double area = 0.0;
  for (const Slot& slot : row) {
    area += slot.area_m2;
  }
  return area;
}

}  // namespace cmn
