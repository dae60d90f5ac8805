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

bool Interior::place_block(const std::string& name, const AtWall& piece, double height) {
  const std::optional<WallPlace> place = layout_.place_at_wall(rng_, piece);
  if (place) {
    put(block(name, place->pose, piece.depth_m, piece.width_m, height));
  }
  return place.has_value();
}

bool Interior::place_sofa_and_television() {
  constexpr double kSofaDepth = 0.9;
  constexpr double kStandDepth = 0.4;
  const Rectangle& room = layout_.area();
  struct Option {
    Side side;
    double sofa, stand, distance, along;
  };
  std::vector<Option> options;
  for (int i = 0; i < 60; ++i) {
    const auto side = static_cast<Side>(draw_index(rng_, 4));
    const bool upright = side == Side::kEast || side == Side::kWest;
    const double depth = upright ? room.width() : room.height();
    const double length = upright ? room.height() : room.width();
    Option o{side, draw_snapped(rng_, 1.6, i < 30 ? 2.4 : 1.8), draw_snapped(rng_, 1.2, 1.7), 0.0,
             0.0};
    // From the wall behind the television to the front of the sofa.
    const double opposite = depth - kSofaDepth;
    o.distance = opposite < 3.8 ? opposite : draw_snapped(rng_, 2.4, 3.2);
    if (o.distance < 1.7 || length < o.sofa) {
      continue;
    }
    o.along = 0.5 * o.sofa + (length - o.sofa) * draw_uniform(rng_);
    options.push_back(o);
  }
  for (const Option& o : options) {
    const Point2 n = normal_of(o.side);
    const Point2 along{std::abs(n.y), std::abs(n.x)};
    const Point2 corner{n.x < 0.0 ? room.x1 : room.x0, n.y < 0.0 ? room.y1 : room.y0};
    const Point2 foot = corner + o.along * along;
    const auto area = [&](double from, double depth, double width) {
      const Point2 a = foot + from * n - (0.5 * width) * along;
      const Point2 b = foot + (from + depth) * n + (0.5 * width) * along;
      return Rectangle{std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x),
                       std::max(a.y, b.y)};
    };
    const Rectangle stand = area(0.0, kStandDepth, o.stand);
    const Rectangle sofa_area = area(o.distance, kSofaDepth, o.sofa);
    RoomLayout trial = layout_;
    if (trial.has_window(stand) || !trial.has_wall(o.side, stand) ||
        !trial.place(stand, {area(kStandDepth, 0.6, o.stand)},
                     {foot + (kStandDepth + 0.5 * params_.way_m + 0.06) * n}) ||
        !trial.place(sofa_area, {area(o.distance - 0.35, 0.35, o.sofa - 0.3)})) {
      continue;
    }
    layout_ = trial;
    const double towards = std::atan2(n.y, n.x);
    const Point2 stand_middle = stand.middle();
    put(block("TV stand", {stand_middle.x, stand_middle.y, towards}, kStandDepth, o.stand, 0.45));
    put(block("TV", {stand_middle.x, stand_middle.y, towards}, 0.08, 0.8 * o.stand, 0.6, 0.5));
    const Point2 sofa_middle = sofa_area.middle();
    put(sofa("sofa", {sofa_middle.x, sofa_middle.y, wrap_angle(towards + kPi)}, kSofaDepth,
             o.sofa));
    if (o.distance > 2.3) {
      const double table_depth = 0.55;
      const double table_width = std::min(1.1, 0.55 * o.sofa);
      const double from = o.distance - 0.38 - table_depth;
      const Rectangle low = area(from, table_depth, table_width);
      if (layout_.place(low, {})) {
        const Point2 m = low.middle();
        put(coffee_table({m.x, m.y, towards}, table_depth, table_width));
      }
    }
    // Armchairs beside the low table, turned towards it.
    for (const double sign : {-1.0, 1.0}) {
      if (!chance(0.45)) {
        continue;
      }
      const Point2 m = foot + (o.distance - 0.6) * n + (sign * (0.5 * o.sofa + 0.5)) * along;
      const Point2 facing = -sign * along;
      const double askew =
          (0.2 + 0.3 * draw_uniform(rng_)) * sign * (n.x * along.y - n.y * along.x);
      const Furniture armchair = sofa(
          "armchair", {m.x, m.y, wrap_angle(std::atan2(facing.y, facing.x) - askew)}, 0.72, 0.74);
      if (layout_.place(armchair.footprint(), {})) {
        put(armchair);
      }
    }
    return true;
  }
  return false;
}

bool Interior::place_dining_set(int chairs_a_side, bool has_head_chairs) {
  const Rectangle& room = layout_.area();
  const double length = 0.62 * chairs_a_side + (chairs_a_side == 1 ? 0.15 : 0.1);
  const double depth = chairs_a_side == 1 ? 0.75 : 0.85;
  constexpr double kOut = 0.38;  // how far a chair stands out from the edge
  for (int attempt = 0; attempt < 40; ++attempt) {
    const bool is_upright = draw_uniform(rng_) < 0.5;
    const double along = length + (has_head_chairs ? 2.0 * kOut : 0.0);
    const double across = depth + 2.0 * kOut;
    const double w = is_upright ? across : along;
    const double h = is_upright ? along : across;
    const double play_x = room.width() - w;
    const double play_y = room.height() - h;
    if (play_x < 0.0 || play_y < 0.0) {
      continue;
    }
    // At first where it has room all round.
    const double x =
        room.x0 + play_x * (attempt < 20 ? 0.2 + 0.6 * draw_uniform(rng_) : draw_uniform(rng_));
    const double y =
        room.y0 + play_y * (attempt < 20 ? 0.2 + 0.6 * draw_uniform(rng_) : draw_uniform(rng_));
    const Rectangle area{x, y, x + w, y + h};
    const double air = attempt < 20 ? 0.35 : 0.1;
    // People get to both long sides, at least to one.
    const Point2 m = area.middle();
    const double beside = 0.5 * (across + params_.way_m) + 0.06;
    std::vector<Point2> sides{m + (is_upright ? Point2{beside, 0.0} : Point2{0.0, beside}),
                              m - (is_upright ? Point2{beside, 0.0} : Point2{0.0, beside})};
    if (attempt >= 30) {
      sides.erase(draw_uniform(rng_) < 0.5 ? sides.begin() : sides.begin() + 1);
    }
    const Rectangle wide = area.grown(air);
    if (!layout_.is_vacant({std::max(wide.x0, room.x0), std::max(wide.y0, room.y0),
                            std::min(wide.x1, room.x1), std::min(wide.y1, room.y1)}) ||
        !layout_.place(area, {}, sides)) {
      continue;
    }
    const Pose2 T_house_table{m.x, m.y, is_upright ? 0.0 : kPi / 2.0};  // y along the table
    put(table("table", T_house_table, depth, length));
    const auto seat = [&](double px, double py, double yaw) {
      const double pull = 0.06 * (2.0 * draw_uniform(rng_) - 1.0);
      const double askew = 0.15 * (2.0 * draw_uniform(rng_) - 1.0);
      const Pose2 at =
          T_house_table * Pose2{px - pull * std::cos(yaw), py - pull * std::sin(yaw), yaw + askew};
      put(chair(at));
    };
    for (int i = 0; i < chairs_a_side; ++i) {
      const double py = (i - 0.5 * (chairs_a_side - 1)) * 0.6;
      seat(-0.5 * depth - 0.06, py, 0.0);
      seat(0.5 * depth + 0.06, py, kPi);
    }
    if (has_head_chairs) {
      seat(0.0, -0.5 * length - 0.06, kPi / 2.0);
      seat(0.0, 0.5 * length + 0.06, -kPi / 2.0);
    }
    return true;
  }
  return false;
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
  constexpr double kDepth = 0.6;
  const Rectangle room = layout_.area();
  double wanted = room.area() > 8.0 ? draw_snapped(rng_, 3.0, 4.2) : draw_snapped(rng_, 2.4, 3.6);
  bool has_begun = false;
  for (int run = 0; run < 2 && wanted > 1.1; ++run) {
    // With the ways kept, the longest run is the best.
    std::vector<WallPlace> stretches;
    for (const Side side : {Side::kEast, Side::kNorth, Side::kWest, Side::kSouth}) {
      const std::optional<WallPlace> stretch = layout_.longest_stretch(side, kDepth);
      if (stretch) {
        stretches.push_back(*stretch);
      }
    }
    const auto length_of = [](const WallPlace& p) {
      return std::max(p.area.width(), p.area.height()) > kDepth + 1e-6
                 ? std::max(p.area.width(), p.area.height())
                 : kDepth;
    };
    std::stable_sort(
        stretches.begin(), stretches.end(),
        [&](const WallPlace& a, const WallPlace& b) { return length_of(a) > length_of(b); });
    bool is_placed = false;
    for (const WallPlace& stretch : stretches) {
      const bool upright = stretch.side == Side::kEast || stretch.side == Side::kWest;
      const double full = upright ? stretch.area.height() : stretch.area.width();
      const double length = std::floor(std::min(full, wanted) / 0.6) * 0.6;
      if (length < (has_begun ? 0.6 : 1.2) - 1e-9) {
        continue;
      }
      // At the end of the stretch that is in a corner of the room.
      Rectangle area = stretch.area;
      double& low = upright ? area.y0 : area.x0;
      double& high = upright ? area.y1 : area.x1;
      const double room_low = upright ? room.y0 : room.x0;
      const bool from_low = low - room_low < 0.01 || draw_uniform(rng_) < 0.3;
      (from_low ? high : low) = from_low ? low + length : high - length;
      const Point2 n = normal_of(stretch.side);
      const Point2 m = area.middle();
      const Rectangle front{m.x - 0.5 * area.width() + n.x * 0.85 * (upright ? 1.0 : 0.0),
                            m.y - 0.5 * area.height() + n.y * 0.85 * (upright ? 0.0 : 1.0),
                            m.x + 0.5 * area.width() + n.x * 0.85 * (upright ? 1.0 : 0.0),
                            m.y + 0.5 * area.height() + n.y * 0.85 * (upright ? 0.0 : 1.0)};
      RoomLayout trial = layout_;
      const Point2 stand = m + (0.5 * kDepth + 0.5 * params_.way_m + 0.06) * n;
      if (!trial.place(area, has_begun ? std::vector<Rectangle>{} : std::vector<Rectangle>{front},
                       {stand})) {
        continue;
      }
      layout_ = trial;
      const auto units = static_cast<int>(std::lround(length / 0.6));
      const double yaw = std::atan2(n.y, n.x);
      const auto unit_pose = [&](double first, double count) {
        const double middle =
            (from_low ? low + 0.6 * (first + 0.5 * count) : high - 0.6 * (first + 0.5 * count));
        return upright ? Pose2{m.x, middle, yaw} : Pose2{middle, m.y, yaw};
      };
      if (has_begun) {
        put(block("counter", unit_pose(0, units), kDepth, length, 0.9));
      } else {
        put(block("fridge", unit_pose(0, 1), kDepth, 0.6, 1.85));
        const int sink = units > 3 ? 2 : 1;
        for (int i = 1; i < units; ++i) {
          const bool is_stove = i == units - 1 && units > 2;
          put(block(i == sink && !is_stove ? "sink"
                    : is_stove             ? "stove"
                                           : "counter",
                    unit_pose(i, 1), kDepth, 0.6, 0.9));
        }
        if (!layout_.has_window(area)) {
          const Pose2 middle = unit_pose(1, units - 1);
          put(block("wall cupboard", middle * Pose2{-0.5 * kDepth + 0.17, 0.0, 0.0}, 0.34,
                    length - 0.6, 0.7, 1.45));
        }
      }
      wanted -= length;
      has_begun = is_placed = true;
      break;
    }
    if (!is_placed) {
      break;
    }
  }
  return has_begun;
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
