// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/room_layout.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace cmn {
namespace {

constexpr double kDoorZone = 0.9;  ///< [m] kept free before a door, which may swing there
constexpr double kReveal = 0.06;   ///< [m] how far a hole in a wall is felt in the room
constexpr double kRaster = 0.1;    ///< [m] of the search for ways
constexpr double kAir = 0.02;      ///< [m] between two pieces

bool is_upright(Side side) { return side == Side::kEast || side == Side::kWest; }

bool touches(const Rectangle& a, const Rectangle& b) { return overlap(a.grown(0.01), b); }

}  // namespace

AtWall against_wall(double width_m, double depth_m, double front_m, Preference preference,
                    bool is_tall) {
  AtWall piece;
  piece.width_m = width_m;
  piece.depth_m = depth_m;
  piece.front_m = front_m;
  piece.preference = preference;
  piece.is_tall = is_tall;
  return piece;
}

Point2 normal_of(Side side) {
  constexpr std::array<Point2, 4> kNormals{Point2{-1.0, 0.0}, Point2{0.0, -1.0}, Point2{1.0, 0.0},
                                           Point2{0.0, 1.0}};
  return kNormals[static_cast<std::size_t>(side)];
}

RoomLayout::RoomLayout(const House& house, int room, double way_m)
    : area_{house.rooms[static_cast<std::size_t>(room)].area}, room_{room}, way_m_{way_m} {
  const auto add_gap = [&](const Rectangle& hole) {
    const bool upright_wall = hole.x1 <= area_.x0 + 1e-9 || hole.x0 >= area_.x1 - 1e-9;
    Rectangle zone = hole;
    Rectangle gap = hole;
    Point2 inside = hole.middle();
    const double step = 0.5 * way_m_ + 0.05;
    if (upright_wall) {
      const bool is_west = hole.x1 <= area_.x0 + 1e-9;
      zone.x0 = is_west ? area_.x0 : area_.x1 - kDoorZone;
      zone.x1 = is_west ? area_.x0 + kDoorZone : area_.x1;
      gap.x0 = is_west ? area_.x0 : area_.x1 - kReveal;
      gap.x1 = is_west ? area_.x0 + kReveal : area_.x1;
      inside.x = is_west ? area_.x0 + step : area_.x1 - step;
    } else {
      const bool is_south = hole.y1 <= area_.y0 + 1e-9;
      zone.y0 = is_south ? area_.y0 : area_.y1 - kDoorZone;
      zone.y1 = is_south ? area_.y0 + kDoorZone : area_.y1;
      gap.y0 = is_south ? area_.y0 : area_.y1 - kReveal;
      gap.y1 = is_south ? area_.y0 + kReveal : area_.y1;
      inside.y = is_south ? area_.y0 + step : area_.y1 - step;
    }
    kept_free_.push_back(zone);
    gaps_.push_back(gap);
    must_reach_.push_back(inside);
  };
  for (const Opening& opening : house.openings) {
    if (opening.room != room && opening.other_room != room) {
      continue;
    }
    if (opening.kind == Opening::Kind::kWindow) {
      windows_.push_back(opening.area.grown(kReveal));
    } else {
      add_gap(opening.area);
    }
  }
  for (std::size_t i = 0; i < house.rooms.size(); ++i) {
    const Rectangle& b = house.rooms[i].area;
    if (static_cast<int>(i) == room || !overlap(b.grown(0.001), area_)) {
      continue;
    }
    // Open plan: the rooms share a side. Its middle stays free, and no piece leans on it.
    const Rectangle side{std::max(b.x0, area_.x0), std::max(b.y0, area_.y0),
                         std::min(b.x1, area_.x1), std::min(b.y1, area_.y1)};
    const bool upright = side.height() > side.width();
    Rectangle hole = side;
    const double half = std::min(0.6, 0.5 * (upright ? side.height() : side.width()));
    const Point2 middle = side.middle();
    (upright ? hole.y0 : hole.x0) = (upright ? middle.y : middle.x) - half;
    (upright ? hole.y1 : hole.x1) = (upright ? middle.y : middle.x) + half;
    add_gap(hole);
    Rectangle whole = side.grown(kReveal);
    gaps_.back() = whole;
  }
}

bool RoomLayout::is_vacant(const Rectangle& area) const {
  const auto meets = [&](const Rectangle& other) { return overlap(area, other); };
  return area.x0 >= area_.x0 - 1e-9 && area.y0 >= area_.y0 - 1e-9 && area.x1 <= area_.x1 + 1e-9 &&
         area.y1 <= area_.y1 + 1e-9 && std::none_of(taken_.begin(), taken_.end(), meets) &&
         std::none_of(kept_free_.begin(), kept_free_.end(), meets);
}

bool RoomLayout::place(const Rectangle& area, const std::vector<Rectangle>& keep_free,
                       const std::vector<Point2>& must_reach) {
  if (!is_vacant(area)) {
    return false;
  }
  for (const Rectangle& zone : keep_free) {
    const bool is_inside = zone.x0 >= area_.x0 - 1e-9 && zone.y0 >= area_.y0 - 1e-9 &&
                           zone.x1 <= area_.x1 + 1e-9 && zone.y1 <= area_.y1 + 1e-9;
    if (!is_inside || std::any_of(taken_.begin(), taken_.end(),
                                  [&](const Rectangle& other) { return overlap(zone, other); })) {
      return false;
    }
  }
  const std::size_t zones = kept_free_.size();
  const std::size_t places = must_reach_.size();
  taken_.push_back(area.grown(kAir));
  kept_free_.insert(kept_free_.end(), keep_free.begin(), keep_free.end());
  must_reach_.insert(must_reach_.end(), must_reach.begin(), must_reach.end());
  if (is_walkable()) {
    return true;
  }
  taken_.pop_back();
  kept_free_.resize(zones);
  must_reach_.resize(places);
  return false;
}

Cell RoomLayout::cell_of(Point2 p) const {
  return {static_cast<int>(std::floor((p.x - area_.x0) / kRaster)),
          static_cast<int>(std::floor((p.y - area_.y0) / kRaster))};
}

/// The floor in cells: 0 free, 1 closed to whoever needs a way's width, 2 reached from the first
/// door.
Grid<std::uint8_t> RoomLayout::ways() const {
  const int width = static_cast<int>(std::ceil(area_.width() / kRaster));
  const int height = static_cast<int>(std::ceil(area_.height() / kRaster));
  Grid<std::uint8_t> floor{width, height};
  const double half = 0.5 * way_m_;
  for (const Rectangle& taken : taken_) {
    const Rectangle grown = taken.grown(half - kAir - 0.5 * kRaster);
    const Cell low = cell_of({grown.x0, grown.y0});
    const Cell high = cell_of({grown.x1, grown.y1});
    for (int y = std::max(0, low.y); y <= std::min(height - 1, high.y); ++y) {
      for (int x = std::max(0, low.x); x <= std::min(width - 1, high.x); ++x) {
        floor({x, y}) = 1;
      }
    }
  }
  // Walls are kept clear of by as much, except that a hall no wider than a way may be walked along
  // its middle.
  const auto rim = [&](double length) {
    return static_cast<int>(
        std::floor(std::max(0.0, std::min(half, 0.5 * length - kRaster)) / kRaster));
  };
  const int rim_x = rim(area_.width());
  const int rim_y = rim(area_.height());
  for (std::size_t i = 0; i < floor.size(); ++i) {
    const Cell c = floor.cell_at(i);
    if (c.x < rim_x || c.y < rim_y || c.x >= width - rim_x || c.y >= height - rim_y) {
      floor[i] = 1;
    }
  }
  std::vector<Cell> front;
  const auto reach = [&](Cell c) {
    if (floor.contains(c) && floor(c) == 0) {
      floor(c) = 2;
      front.push_back(c);
    }
  };
  reach(cell_of(must_reach_.front()));
  while (!front.empty()) {
    const Cell c = front.back();
    front.pop_back();
    for (const Heading h : kHeadings) {
      reach(c + unit_step(h));
    }
  }
  return floor;
}

bool RoomLayout::is_walkable() const {
  if (must_reach_.empty()) {
    return true;
  }
  const Grid<std::uint8_t> floor = ways();
  return std::all_of(must_reach_.begin(), must_reach_.end(), [&](Point2 p) {
    const Cell c = cell_of(p);
    return floor.contains(c) && floor(c) == 2;
  });
}

double RoomLayout::walkable_share() const {
  if (must_reach_.empty()) {
    return 0.0;
  }
  const Grid<std::uint8_t> floor = ways();
  const auto reached = std::count(floor.values().begin(), floor.values().end(), 2);
  const auto free = std::count(floor.values().begin(), floor.values().end(), 0) + reached;
  return free == 0 ? 0.0 : static_cast<double>(reached) / static_cast<double>(free);
}

bool RoomLayout::has_wall(Side side, const Rectangle& area) const {
  const Point2 n = normal_of(side);
  const Rectangle strip{n.x > 0   ? area.x0
                        : n.x < 0 ? area.x1 - kReveal
                                  : area.x0,
                        n.y > 0   ? area.y0
                        : n.y < 0 ? area.y1 - kReveal
                                  : area.y0,
                        n.x > 0 ? area.x0 + kReveal : area.x1,
                        n.y > 0 ? area.y0 + kReveal : area.y1};
  return std::none_of(gaps_.begin(), gaps_.end(),
                      [&](const Rectangle& gap) { return overlap(gap, strip); });
}

bool RoomLayout::has_window(const Rectangle& area) const {
  return std::any_of(windows_.begin(), windows_.end(),
                     [&](const Rectangle& window) { return touches(area, window); });
}

WallPlace RoomLayout::at(Side side, double begin, const AtWall& piece) const {
  WallPlace place;
  place.side = side;
  const double w = piece.width_m;
  const double d = piece.depth_m;
  switch (side) {
    case Side::kEast:
      place.area = {area_.x1 - d, area_.y0 + begin, area_.x1, area_.y0 + begin + w};
      break;
    case Side::kNorth:
      place.area = {area_.x0 + begin, area_.y1 - d, area_.x0 + begin + w, area_.y1};
      break;
    case Side::kWest:
      place.area = {area_.x0, area_.y0 + begin, area_.x0 + d, area_.y0 + begin + w};
      break;
    case Side::kSouth:
      place.area = {area_.x0 + begin, area_.y0, area_.x0 + begin + w, area_.y0 + d};
      break;
  }
  const Point2 middle = place.area.middle();
  const Point2 n = normal_of(side);
  place.pose = {middle.x, middle.y, std::atan2(n.y, n.x)};
  return place;
}

bool RoomLayout::try_at(const WallPlace& place, const AtWall& piece) {
  if (!has_wall(place.side, place.area) || (piece.is_tall && has_window(place.area))) {
    return false;
  }
  const Point2 n = normal_of(place.side);
  const Point2 along{-n.y, n.x};
  const Point2 front_middle = place.area.middle() + (0.5 * (piece.depth_m + piece.front_m)) * n;
  const auto zone = [](Point2 middle, Point2 a, double a_length, Point2 b, double b_length) {
    const double half_x = 0.5 * (std::abs(a.x) * a_length + std::abs(b.x) * b_length);
    const double half_y = 0.5 * (std::abs(a.y) * a_length + std::abs(b.y) * b_length);
    return Rectangle{middle.x - half_x, middle.y - half_y, middle.x + half_x, middle.y + half_y};
  };
  std::vector<Rectangle> fronts;
  std::vector<Point2> goals;
  if (piece.front_m > 0.0) {
    fronts.push_back(zone(front_middle, n, piece.front_m, along, piece.width_m));
    goals.push_back(place.area.middle() + (0.5 * piece.depth_m + 0.5 * way_m_ + 0.05) * n);
  }
  if (piece.beside_m <= 0.0) {
    return this->place(place.area, fronts, goals);
  }
  const double length = piece.depth_m - piece.beside_from_m;
  const auto beside = [&](double sign) {
    const Point2 middle = place.area.middle() +
                          (sign * 0.5 * (piece.width_m + piece.beside_m)) * along +
                          (0.5 * piece.beside_from_m) * n;
    return zone(middle, n, length, along, piece.beside_m);
  };
  const auto with = [&](const std::vector<double>& signs) {
    std::vector<Rectangle> zones = fronts;
    std::vector<Point2> places = goals;
    for (const double sign : signs) {
      zones.push_back(beside(sign));
      places.push_back(place.area.middle() +
                       (sign * (0.5 * piece.width_m + 0.5 * way_m_ + 0.05)) * along +
                       (0.5 * piece.depth_m - 0.3) * n);
    }
    return this->place(place.area, zones, places);
  };
  return with({-1.0, 1.0}) || (piece.is_one_side_enough && (with({-1.0}) || with({1.0})));
}

std::optional<WallPlace> RoomLayout::place_at_wall(std::mt19937_64& rng, const AtWall& piece) {
  constexpr double kStep = 0.1;  // [m] between the places that are tried
  std::array<Side, 4> sides{Side::kEast, Side::kNorth, Side::kWest, Side::kSouth};
  for (std::size_t i = sides.size(); i > 1; --i) {
    std::swap(sides[i - 1], sides[draw_index(rng, i)]);
  }
  // First the places that are wanted, at each wall; then any.
  for (const bool is_wish : {true, false}) {
    for (const Side side : sides) {
      const double length = is_upright(side) ? area_.height() : area_.width();
      const double play = length - piece.width_m;
      const double depth = is_upright(side) ? area_.width() : area_.height();
      if (play < 0.0 || depth < piece.depth_m) {
        continue;
      }
      std::vector<double> begins;
      if (!is_wish) {
        const double first = draw_uniform(rng);  // all along the wall, from anywhere on
        const int count = static_cast<int>(play / kStep) + 1;
        for (int i = 0; i < count; ++i) {
          begins.push_back(play * std::fmod(first + static_cast<double>(i) / count, 1.0));
        }
      } else if (piece.preference == Preference::kCorner) {
        begins = {0.0, play};
        if (draw_uniform(rng) < 0.5) {
          std::swap(begins[0], begins[1]);
        }
      } else if (piece.preference == Preference::kMiddle) {
        begins = {0.5 * play, (0.35 + 0.3 * draw_uniform(rng)) * play};
      }
      for (const double begin : begins) {
        const WallPlace place = at(side, begin, piece);
        if (try_at(place, piece)) {
          return place;
        }
      }
    }
  }
  return std::nullopt;
}

std::optional<WallPlace> RoomLayout::longest_stretch(Side side, double depth_m) const {
  const double length = is_upright(side) ? area_.height() : area_.width();
  const double step = 0.05;
  double begin = 0.0;
  double best_begin = 0.0;
  double best = 0.0;
  const int steps = static_cast<int>(std::floor(length / step + 1e-6));
  AtWall sliver;
  sliver.width_m = step;
  sliver.depth_m = depth_m;
  for (int i = 0; i < steps; ++i) {
    const WallPlace place = at(side, i * step, sliver);
    if (!is_vacant(place.area) || !has_wall(side, place.area)) {
      begin = (i + 1) * step;
    } else if ((i + 1) * step - begin > best + 1e-9) {
      best = (i + 1) * step - begin;
      best_begin = begin;
    }
  }
  if (best <= 0.0) {
    return std::nullopt;
  }
  sliver.width_m = best;
  return at(side, best_begin, sliver);
}

}  // namespace cmn
