// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/interior.hpp"

#include "coarse_map_nav/evaluation/furniture_catalogue.hpp"
#include "coarse_map_nav/evaluation/plan_draws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace cmn {

namespace {

constexpr double kSofaDepth = 0.9;
constexpr double kStandDepth = 0.4;
constexpr double kChairOut = 0.38;  ///< [m] how far a chair stands out from its table's edge
constexpr double kCounterDepth = 0.6;
constexpr double kUnit = 0.6;  ///< [m] width of a piece of kitchen

/// The smallest area along the axes around a rectangle of a group's frame.
Rectangle covered(const Pose2& T_house_group, const Rectangle& local) {
  const double c = std::abs(std::cos(T_house_group.yaw));
  const double s = std::abs(std::sin(T_house_group.yaw));
  const Point2 m = T_house_group * local.middle();
  const double half_x = 0.5 * (c * local.width() + s * local.height());
  const double half_y = 0.5 * (s * local.width() + c * local.height());
  return {m.x - half_x, m.y - half_y, m.x + half_x, m.y + half_y};
}
/// `depth` x `width` with its back at `from` and its middle on the x axis.
Rectangle centred(double from, double depth, double width) {
  return {from, -0.5 * width, from + depth, 0.5 * width};
}
Rectangle common(const Rectangle& a, const Rectangle& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

}  // namespace

bool Interior::place_block(const std::string& name, const AtWall& piece, double height) {
  const std::optional<WallPlace> place = layout_.place_at_wall(rng_, piece);
  if (place) {
    put(block(name, place->pose, piece.depth_m, piece.width_m, height));
  }
  return place.has_value();
}

bool Interior::place_sofa_and_television() {
  constexpr int kAttempts = 60;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const std::optional<SofaGroup> group = draw_sofa_group(attempt < kAttempts / 2 ? 2.4 : 1.8);
    if (group && place(*group)) {
      return true;
    }
  }
  return false;
}

std::optional<Interior::SofaGroup> Interior::draw_sofa_group(double longest_sofa_m) {
  const Rectangle& room = layout_.area();
  SofaGroup group;
  group.side = static_cast<Side>(draw_index(rng_, 4));
  const Point2 n = normal_of(group.side);
  const double depth = n.x != 0.0 ? room.width() : room.height();
  const double length = n.x != 0.0 ? room.height() : room.width();
  group.sofa_m = draw_snapped(rng_, 1.6, longest_sofa_m);
  group.stand_m = draw_snapped(rng_, 1.2, 1.7);
  // With its back to the opposite wall, or standing free in a large room.
  const double opposite = depth - kSofaDepth;
  group.distance_m = opposite < 3.8 ? opposite : draw_snapped(rng_, 2.4, 3.2);
  if (group.distance_m < 1.7 || length < group.sofa_m) {
    return std::nullopt;
  }
  const double along = 0.5 * group.sofa_m + (length - group.sofa_m) * draw_uniform(rng_);
  const Point2 corner{n.x < 0.0 ? room.x1 : room.x0, n.y < 0.0 ? room.y1 : room.y0};
  const Point2 foot = corner + along * Point2{std::abs(n.y), std::abs(n.x)};
  group.T_house_foot = {foot.x, foot.y, std::atan2(n.y, n.x)};
  return group;
}

bool Interior::place(const SofaGroup& group) {
  const Pose2& T_house_foot = group.T_house_foot;
  const Rectangle stand = covered(T_house_foot, centred(0.0, kStandDepth, group.stand_m));
  const double viewer = kStandDepth + 0.5 * params_.way_m + 0.06;
  RoomLayout trial = layout_;
  if (trial.has_window(stand) || !trial.has_wall(group.side, stand) ||
      !trial.place(stand, {covered(T_house_foot, centred(kStandDepth, 0.6, group.stand_m))},
                   {T_house_foot * Point2{viewer, 0.0}}) ||
      !trial.place(
          covered(T_house_foot, centred(group.distance_m, kSofaDepth, group.sofa_m)),
          {covered(T_house_foot, centred(group.distance_m - 0.35, 0.35, group.sofa_m - 0.3))})) {
    return false;
  }
  layout_ = trial;
  const Pose2 T_house_stand = T_house_foot * Pose2{0.5 * kStandDepth, 0.0, 0.0};
  put(block("TV stand", T_house_stand, kStandDepth, group.stand_m, 0.45));
  put(block("TV", T_house_stand, 0.08, 0.8 * group.stand_m, 0.6, 0.5));
  put(sofa("sofa", T_house_foot * Pose2{group.distance_m + 0.5 * kSofaDepth, 0.0, kPi}, kSofaDepth,
           group.sofa_m));
  if (group.distance_m > 2.3) {
    const double depth = 0.55;
    const double width = std::min(1.1, 0.55 * group.sofa_m);
    const double from = group.distance_m - 0.38 - depth;
    if (layout_.place(covered(T_house_foot, centred(from, depth, width)), {})) {
      put(coffee_table(T_house_foot * Pose2{from + 0.5 * depth, 0.0, 0.0}, depth, width));
    }
  }
  // Armchairs beside the low table, turned towards it and a little to the television.
  for (const double sign : {-1.0, 1.0}) {
    if (!chance(0.45)) {
      continue;
    }
    const double askew = 0.2 + 0.3 * draw_uniform(rng_);
    const Pose2 at{group.distance_m - 0.6, sign * (0.5 * group.sofa_m + 0.5),
                   -sign * (0.5 * kPi + askew)};
    const Furniture armchair = sofa("armchair", T_house_foot * at, 0.72, 0.74);
    if (layout_.place(armchair.footprint(), {})) {
      put(armchair);
    }
  }
  return true;
}

bool Interior::place_dining_set(int chairs_a_side, bool has_head_chairs) {
  constexpr int kAttempts = 40;
  const Rectangle& room = layout_.area();
  const double length = 0.62 * chairs_a_side + (chairs_a_side == 1 ? 0.15 : 0.1);
  const double depth = chairs_a_side == 1 ? 0.75 : 0.85;
  const double along = length + (has_head_chairs ? 2.0 * kChairOut : 0.0);
  const double across = depth + 2.0 * kChairOut;
  const Rectangle whole{-0.5 * across, -0.5 * along, 0.5 * across, 0.5 * along};
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    // At first where it has room all round; then anywhere. People get to both long sides, at last
    // to one.
    const bool is_wish = attempt < kAttempts / 2;
    const bool is_last = attempt >= kAttempts * 3 / 4;
    const double yaw = draw_uniform(rng_) < 0.5 ? 0.0 : 0.5 * kPi;
    const Rectangle size = covered({0.0, 0.0, yaw}, whole);
    const double play_x = room.width() - size.width();
    const double play_y = room.height() - size.height();
    if (play_x < 0.0 || play_y < 0.0) {
      continue;
    }
    const double rim = is_wish ? 0.2 : 0.0;
    const Pose2 T_house_table{room.x0 - size.x0 + play_x * draw_between(rng_, rim, 1.0 - rim),
                              room.y0 - size.y0 + play_y * draw_between(rng_, rim, 1.0 - rim), yaw};
    const double beside = 0.5 * (across + params_.way_m) + 0.06;
    std::vector<Point2> sides{T_house_table * Point2{beside, 0.0},
                              T_house_table * Point2{-beside, 0.0}};
    if (is_last) {
      sides.erase(draw_uniform(rng_) < 0.5 ? sides.begin() : sides.begin() + 1);
    }
    const Rectangle area = covered(T_house_table, whole);
    if (layout_.is_vacant(common(area.grown(is_wish ? 0.35 : 0.1), room)) &&
        layout_.place(area, {}, sides)) {
      put(table("table", T_house_table, depth, length));
      put_chairs(T_house_table, depth, length, chairs_a_side, has_head_chairs);
      return true;
    }
  }
  return false;
}

void Interior::put_chairs(const Pose2& T_house_table, double depth, double length,
                          int chairs_a_side, bool has_head_chairs) {
  constexpr double kBack = 0.06;  // of the seat's middle from the table's edge
  const auto seat = [&](double x, double y, double yaw) {
    const double pull = 0.06 * (2.0 * draw_uniform(rng_) - 1.0);
    const double askew = 0.15 * (2.0 * draw_uniform(rng_) - 1.0);
    put(chair(T_house_table * Pose2{x, y, yaw} * Pose2{-pull, 0.0, askew}));
  };
  for (int i = 0; i < chairs_a_side; ++i) {
    const double y = (i - 0.5 * (chairs_a_side - 1)) * 0.6;
    seat(-0.5 * depth - kBack, y, 0.0);
    seat(0.5 * depth + kBack, y, kPi);
  }
  if (has_head_chairs) {
    seat(0.0, -0.5 * length - kBack, 0.5 * kPi);
    seat(0.0, 0.5 * length + kBack, -0.5 * kPi);
  }
}

bool Interior::place_desk_and_chair() {
  constexpr double kDepth = 0.65;
  const double width = draw_snapped(rng_, 1.2, 1.6);
  AtWall piece = against_wall(width, kDepth + 0.5, 0.0, Preference::kCorner);
  const std::optional<WallPlace> place = layout_.place_at_wall(rng_, piece);
  if (!place) {
    return false;
  }
  // The footprint holds the desk at the wall and the chair before it.
  put(desk(place->pose * Pose2{-0.25, 0.0, 0.0}, kDepth, width));
  put(office_chair(place->pose * Pose2{0.26, -0.15 * (draw_uniform(rng_) - 0.2),
                                       kPi + 0.8 * (draw_uniform(rng_) - 0.5)}));
  return true;
}

bool Interior::place_double_bed(double width) {
  AtWall piece = against_wall(width, 2.05, 0.55, Preference::kMiddle);
  piece.beside_m = 0.5;
  piece.beside_from_m = 0.5;
  std::optional<WallPlace> place = layout_.place_at_wall(rng_, piece);
  if (!place) {
    piece.front_m = 0.0;
    piece.is_one_side_enough = true;
    piece.preference = Preference::kCorner;
    place = layout_.place_at_wall(rng_, piece);
  }
  if (!place) {
    return false;
  }
  put(bed("bed", place->pose, piece.depth_m, width));
  for (const double sign : {-1.0, 1.0}) {
    const Pose2 at =
        place->pose * Pose2{-0.5 * piece.depth_m + 0.2, sign * (0.5 * width + 0.26), 0.0};
    Furniture nightstand = block("nightstand", at, 0.4, 0.44, 0.5);
    if (layout_.place(nightstand.footprint(), {})) {
      put(nightstand);
    }
  }
  return true;
}

bool Interior::place_kitchen_counter() {
  constexpr double kShortest = 2.0 * kUnit;
  const double wanted =
      layout_.area().area() > 8.0 ? draw_snapped(rng_, 3.0, 4.2) : draw_snapped(rng_, 2.4, 3.6);
  const double first = place_counter_run(wanted, kShortest, true);
  if (first > 0.0 && wanted - first > kShortest) {
    place_counter_run(wanted - first, kUnit, false);
  }
  return first > 0.0;
}

double Interior::place_counter_run(double longest_m, double shortest_m, bool is_first) {
  std::vector<WallPlace> stretches;
  for (const Side side : {Side::kEast, Side::kNorth, Side::kWest, Side::kSouth}) {
    const std::optional<WallPlace> stretch = layout_.longest_stretch(side, kCounterDepth);
    if (stretch) {
      stretches.push_back(*stretch);
    }
  }
  const auto length_of = [](const WallPlace& p) {
    return normal_of(p.side).x != 0.0 ? p.area.height() : p.area.width();
  };
  std::stable_sort(stretches.begin(), stretches.end(), [&](const WallPlace& a, const WallPlace& b) {
    return length_of(a) > length_of(b);
  });
  for (const WallPlace& stretch : stretches) {
    const double length = std::floor(std::min(length_of(stretch), longest_m) / kUnit) * kUnit;
    if (length < shortest_m - 1e-9) {
      continue;
    }
    // From the end of the stretch that is in a corner of the room. In the frame of the run, x
    // leads into the room and y along the wall; `sign` says which way.
    const Rectangle& room = layout_.area();
    const bool is_upright = normal_of(stretch.side).x != 0.0;
    const bool is_low_corner =
        is_upright ? stretch.area.y0 - room.y0 < 0.01 : stretch.area.x0 - room.x0 < 0.01;
    const bool from_low = is_low_corner || draw_uniform(rng_) < 0.3;
    const bool y_is_low_to_high = stretch.side == Side::kWest || stretch.side == Side::kNorth;
    const double sign = from_low == y_is_low_to_high ? 1.0 : -1.0;
    const Pose2 T_house_run =
        stretch.pose * Pose2{-0.5 * kCounterDepth, -sign * 0.5 * length_of(stretch), 0.0};
    const double middle = sign * 0.5 * length;
    const auto strip = [&](double from, double depth) {
      return covered(T_house_run * Pose2{0.0, middle, 0.0}, centred(from, depth, length));
    };
    const Rectangle area = strip(0.0, kCounterDepth);
    std::vector<Rectangle> front;
    if (is_first) {
      front.push_back(strip(kCounterDepth, 0.55));
    }
    const Point2 cook = T_house_run * Point2{kCounterDepth + 0.5 * params_.way_m + 0.06, middle};
    if (layout_.place(area, front, {cook})) {
      put_kitchen(T_house_run, sign, static_cast<int>(std::lround(length / kUnit)), is_first,
                  layout_.has_window(area));
      return length;
    }
  }
  return 0.0;
}

void Interior::put_kitchen(const Pose2& T_house_run, double sign, int units, bool is_first,
                           bool has_window) {
  const auto at = [&](double x, int first, int count) {
    return T_house_run * Pose2{x, sign * kUnit * (first + 0.5 * count), 0.0};
  };
  const double middle = 0.5 * kCounterDepth;
  if (!is_first) {
    put(block("counter", at(middle, 0, units), kCounterDepth, units * kUnit, 0.9));
    return;
  }
  put(block("fridge", at(middle, 0, 1), kCounterDepth, kUnit, 1.85));
  const int sink = units > 3 ? 2 : 1;
  for (int i = 1; i < units; ++i) {
    const bool is_stove = i == units - 1 && units > 2;
    const char* name = is_stove ? "stove" : i == sink ? "sink" : "counter";
    put(block(name, at(middle, i, 1), kCounterDepth, kUnit, 0.9));
  }
  if (!has_window) {
    put(block("wall cupboard", at(0.17, 1, units - 1), 0.34, (units - 1) * kUnit, 0.7, 1.45));
  }
}

bool Interior::place_single_bed(double width) {
  const std::optional<WallPlace> place =
      layout_.place_at_wall(rng_, against_wall(2.05, width, 0.55, Preference::kCorner));
  if (place) {  // its head is at one end
    put(bed("bed", place->pose * Pose2{0.0, 0.0, kPi / 2.0}, 2.05, width));
  }
  return place.has_value();
}

bool Interior::place_toilet() {
  const std::optional<WallPlace> place =
      layout_.place_at_wall(rng_, against_wall(0.55, 0.68, 0.5, Preference::kCorner));
  if (place) {
    put(toilet(place->pose));
  }
  return place.has_value();
}

bool Interior::place_small_sofa() {
  const std::optional<WallPlace> place =
      layout_.place_at_wall(rng_, against_wall(1.6, 0.85, 0.5, Preference::kMiddle));
  if (place) {
    put(sofa("sofa", place->pose, 0.85, 1.6));
  }
  return place.has_value();
}

bool Interior::place_plant() {
  const std::optional<WallPlace> place =
      layout_.place_at_wall(rng_, against_wall(0.42, 0.42, 0.0, Preference::kCorner));
  if (place) {
    put(block("plant", place->pose, 0.4, 0.4, 1.2, 0.0, true));
  }
  return place.has_value();
}

}  // namespace cmn
