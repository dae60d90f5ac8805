// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/openings.hpp"

#include "coarse_map_nav/evaluation/plan_draws.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace cmn {
namespace {

using Kind = Opening::Kind;

const Rectangle& area_of(const House& house, int room) {
  return house.rooms[static_cast<std::size_t>(room)].area;
}

}  // namespace

std::optional<Rectangle> wall_between(const Rectangle& a, const Rectangle& b) {
  constexpr double kThickest = 0.55;
  const double x0 = std::max(a.x0, b.x0);
  const double x1 = std::min(a.x1, b.x1);
  const double y0 = std::max(a.y0, b.y0);
  const double y1 = std::min(a.y1, b.y1);
  if (y1 > y0 && x0 > x1 - 1e-9 && x0 - x1 < kThickest) {
    return Rectangle{x1, y0, x0, y1};
  }
  if (x1 > x0 && y0 > y1 - 1e-9 && y0 - y1 < kThickest) {
    return Rectangle{x0, y1, x1, y0};
  }
  return std::nullopt;
}

std::vector<OuterWall> outer_walls(const House& house, int room, double thickness) {
  const Rectangle& a = house.rooms[static_cast<std::size_t>(room)].area;
  const std::vector<OuterWall> sides{{{a.x1, a.y0, a.x1 + thickness, a.y1}, 0},
                                     {{a.x0, a.y1, a.x1, a.y1 + thickness}, 1},
                                     {{a.x0 - thickness, a.y0, a.x0, a.y1}, 2},
                                     {{a.x0, a.y0 - thickness, a.x1, a.y0}, 3}};
  std::vector<OuterWall> outer;
  for (const OuterWall& side : sides) {
    const Rectangle beyond = side.area.grown(thickness);
    const bool is_outer =
        std::none_of(house.rooms.begin(), house.rooms.end(), [&](const Room& other) {
          return &other.area != &a &&
                 overlap(side.side % 2 == 0
                             ? Rectangle{beyond.x0, side.area.y0, beyond.x1, side.area.y1}
                             : Rectangle{side.area.x0, beyond.y0, side.area.x1, beyond.y1},
                         other.area);
        });
    if (is_outer) {
      outer.push_back(side);
    }
  }
  return outer;
}

bool add_door(House& house, std::mt19937_64& rng, int room, int other, double width) {
  constexpr double kJamb = 0.1;
  const std::optional<Rectangle> wall = wall_between(area_of(house, room), area_of(house, other));
  if (!wall) {
    return false;
  }
  const bool is_upright = wall->height() > wall->width();
  const double begin = is_upright ? wall->y0 : wall->x0;
  const double room_left = (is_upright ? wall->height() : wall->width()) - width - 2.0 * kJamb;
  if (room_left < -1e-9) {
    return false;
  }
  // Most doors are beside a corner, which leaves the wall to the furniture.
  const double lot = draw_uniform(rng);
  const double offset = lot < 0.42   ? std::min(room_left, draw_snapped(rng, 0.0, 0.15))
                        : lot < 0.84 ? std::max(0.0, room_left - draw_snapped(rng, 0.0, 0.15))
                                     : snapped(room_left * draw_uniform(rng));
  const double at = snapped(begin + kJamb + offset);
  Opening door;
  door.area = is_upright ? Rectangle{wall->x0, at, wall->x1, at + width}
                         : Rectangle{at, wall->y0, at + width, wall->y1};
  door.room = room;
  door.other_room = other;
  house.openings.push_back(door);
  return true;
}

bool add_passage(House& house, std::mt19937_64& rng, int room, int other, double narrowest,
                 double widest) {
  const std::optional<Rectangle> wall = wall_between(area_of(house, room), area_of(house, other));
  if (!wall) {
    return false;
  }
  const double length = std::max(wall->width(), wall->height());
  if (length < narrowest) {
    return false;
  }
  const double width = draw_snapped(rng, narrowest, std::min(length, widest));
  const double offset = snapped((length - width) * draw_uniform(rng));
  Opening passage;
  passage.kind = Kind::kPassage;
  passage.top_m = 2.2;
  passage.area = wall->height() > wall->width()
                     ? Rectangle{wall->x0, wall->y0 + offset, wall->x1, wall->y0 + offset + width}
                     : Rectangle{wall->x0 + offset, wall->y0, wall->x0 + offset + width, wall->y1};
  passage.room = room;
  passage.other_room = other;
  house.openings.push_back(passage);
  return true;
}

bool add_entrance(House& house, int hall, double outer_wall_m) {
  constexpr double kWidth = 0.9;
  std::vector<OuterWall> sides = outer_walls(house, hall, outer_wall_m);
  // The shortest side: the end of a corridor.
  std::stable_sort(sides.begin(), sides.end(), [](const OuterWall& a, const OuterWall& b) {
    return std::max(a.area.width(), a.area.height()) < std::max(b.area.width(), b.area.height());
  });
  if (sides.empty()) {
    return false;
  }
  const Rectangle& wall = sides.front().area;
  const bool is_upright = sides.front().side % 2 == 0;
  const double length = is_upright ? wall.height() : wall.width();
  if (length < kWidth + 0.1) {
    return false;
  }
  const double offset = snapped(0.5 * (length - kWidth));
  Opening entrance;
  entrance.kind = Kind::kEntrance;
  entrance.area = is_upright
                      ? Rectangle{wall.x0, wall.y0 + offset, wall.x1, wall.y0 + offset + kWidth}
                      : Rectangle{wall.x0 + offset, wall.y0, wall.x0 + offset + kWidth, wall.y1};
  entrance.room = hall;
  house.openings.push_back(entrance);
  return true;
}

void add_windows(House& house, std::mt19937_64& rng, double outer_wall_m) {
  for (std::size_t r = 0; r < house.rooms.size(); ++r) {
    const RoomPurpose purpose = house.rooms[r].purpose;
    if (purpose == RoomPurpose::kHall || purpose == RoomPurpose::kStorage) {
      continue;
    }
    const bool is_bath = purpose == RoomPurpose::kBath;
    for (const OuterWall& side : outer_walls(house, static_cast<int>(r), outer_wall_m)) {
      const bool is_upright = side.side % 2 == 0;
      const double length = is_upright ? side.area.height() : side.area.width();
      const double width = is_bath ? 0.6 : draw_snapped(rng, 0.35 * length, 0.6 * length);
      const double offset = snapped((length - width) * draw_between(rng, 0.3, 0.7));
      Opening window;
      window.kind = Kind::kWindow;
      window.bottom_m = is_bath ? 1.4 : 0.9;
      window.area = side.area;
      (is_upright ? window.area.y0 : window.area.x0) += offset;
      (is_upright ? window.area.y1 : window.area.x1) =
          (is_upright ? window.area.y0 : window.area.x0) + width;
      window.room = static_cast<int>(r);
      house.openings.push_back(window);
      if (is_bath) {
        break;
      }
    }
  }
}

std::vector<Wall> wall_blocks(const House& house) {
  std::vector<Rectangle> solid{house.outline};
  const auto cut = [&](const Rectangle& hole) {
    std::vector<Rectangle> left;
    for (const Rectangle& block : solid) {
      if (!overlap(block, hole)) {
        left.push_back(block);
        continue;
      }
      const Rectangle middle{block.x0, std::max(block.y0, hole.y0), block.x1,
                             std::min(block.y1, hole.y1)};
      const std::vector<Rectangle> pieces{
          {block.x0, block.y0, block.x1, middle.y0},
          {block.x0, middle.y1, block.x1, block.y1},
          {block.x0, middle.y0, std::max(block.x0, hole.x0), middle.y1},
          {std::min(block.x1, hole.x1), middle.y0, block.x1, middle.y1}};
      std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(left),
                   [](const Rectangle& r) { return r.width() > 1e-6 && r.height() > 1e-6; });
    }
    solid = std::move(left);
  };
  for (const Rectangle& notch : house.notches) {
    cut(notch);
  }
  for (const Room& room : house.rooms) {
    cut(room.area);
  }
  std::vector<Wall> walls;
  for (const Opening& opening : house.openings) {
    cut(opening.area);
    walls.push_back({opening.area, opening.top_m, house.ceiling_m});
    if (opening.kind == Kind::kWindow) {
      walls.push_back({opening.area, 0.0, opening.bottom_m});
    }
  }
  for (const Rectangle& block : solid) {
    walls.push_back({block, 0.0, house.ceiling_m});
  }
  return walls;
}

}  // namespace cmn
