// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/house.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace cmn {
namespace {

constexpr double kRounding = 1e-6;  // [cells]

bool meets(double bottom_m, double top_m, HeightBand band) {
  return bottom_m <= band.top_m && top_m >= band.bottom_m;
}

/// Sets the cells whose middles lie within a rectangle of the house frame.
void set(Grid<std::uint8_t>& grid, double resolution, const Rectangle& area, std::uint8_t value) {
  const auto first = [&](double low) {
    return std::max(0, static_cast<int>(std::ceil(low / resolution - 0.5 - kRounding)));
  };
  const auto end = [&](double high, int size) {
    return std::min(size, static_cast<int>(std::ceil(high / resolution - 0.5 - kRounding)));
  };
  for (int y = first(area.y0); y < end(area.y1, grid.height()); ++y) {
    for (int x = first(area.x0); x < end(area.x1, grid.width()); ++x) {
      grid({x, y}) = value;
    }
  }
}

void set(Grid<std::uint8_t>& grid, double resolution, const Furniture& piece,
         const FurniturePart& part) {
  const Pose2 T_piece_house = inverse(piece.T_house_piece);
  const Point2 middle = piece.T_house_piece * part.area.middle();
  const double reach = 0.5 * std::hypot(part.area.width(), part.area.height());
  const auto cell = [&](double metres) {
    return static_cast<int>(std::floor(metres / resolution));
  };
  for (int y = cell(middle.y - reach); y <= cell(middle.y + reach); ++y) {
    for (int x = cell(middle.x - reach); x <= cell(middle.x + reach); ++x) {
      const Point2 p = T_piece_house * Point2{(x + 0.5) * resolution, (y + 0.5) * resolution};
      const Point2 d = p - part.area.middle();
      const double u = std::abs(d.x) / (0.5 * part.area.width());
      const double v = std::abs(d.y) / (0.5 * part.area.height());
      const bool is_in = part.is_round ? u * u + v * v <= 1.0 : std::max(u, v) <= 1.0;
      const bool is_middle = x == cell(middle.x) && y == cell(middle.y);
      if ((is_in || is_middle) && grid.contains({x, y})) {
        grid({x, y}) = 1;
      }
    }
  }
}

}  // namespace

const char* name(RoomPurpose purpose) {
  constexpr std::array<const char*, 8> kNames{"living", "kitchen", "dining",  "bedroom",
                                              "bath",   "office",  "storage", "hall"};
  return kNames[static_cast<std::size_t>(purpose)];
}

double Opening::width_m() const {
  // As thick as the wall, which is thinner than any door is wide.
  return std::max(area.width(), area.height());
}

Rectangle Furniture::footprint() const {
  const double c = std::abs(std::cos(T_house_piece.yaw));
  const double s = std::abs(std::sin(T_house_piece.yaw));
  const double half_x = 0.5 * (c * size_x_m + s * size_y_m);
  const double half_y = 0.5 * (s * size_x_m + c * size_y_m);
  return {T_house_piece.x - half_x, T_house_piece.y - half_y, T_house_piece.x + half_x,
          T_house_piece.y + half_y};
}

double House::area_m2() const {
  double area = 0.0;
  for (const Room& room : rooms) {
    area += room.area.area();
  }
  return area;
}

CoarseMap walls(const House& house, double resolution) {
  if (!(resolution > 0.0) || !std::isfinite(resolution)) {
    throw std::invalid_argument("a cell of a house's map must have a size above 0");
  }
  const auto cells = [&](double metres) {
    return static_cast<int>(std::ceil(metres / resolution - kRounding));
  };
  Grid<std::uint8_t> grid{cells(house.outline.x1), cells(house.outline.y1), 1};
  for (const Room& room : house.rooms) {
    set(grid, resolution, room.area, 0);
  }
  for (const Opening& opening : house.openings) {
    if (opening.kind == Opening::Kind::kDoor || opening.kind == Opening::Kind::kPassage) {
      set(grid, resolution, opening.area, 0);
    }
  }
  return {std::move(grid), resolution};
}

CoarseMap occupancy(const House& house, double resolution, HeightBand band) {
  Grid<std::uint8_t> grid = walls(house, resolution).occupied();
  for (const Furniture& piece : house.furniture) {
    for (const FurniturePart& part : piece.parts) {
      if (meets(part.bottom_m, part.top_m, band)) {
        set(grid, resolution, piece, part);
      }
    }
  }
  return {std::move(grid), resolution};
}

}  // namespace cmn
