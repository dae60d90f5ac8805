// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A furnished home: what a LiDAR, a camera and a robot meet in it.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace cmn {

/// An area with sides along the axes [m].
struct Rectangle {
  double x0 = 0.0, y0 = 0.0;
  double x1 = 0.0, y1 = 0.0;

  double width() const { return x1 - x0; }
  double height() const { return y1 - y0; }
  double area() const { return width() * height(); }
  Point2 middle() const { return {0.5 * (x0 + x1), 0.5 * (y0 + y1)}; }
  Rectangle grown(double by) const { return {x0 - by, y0 - by, x1 + by, y1 + by}; }
};
/// Whether they share more than a border.
inline bool overlap(const Rectangle& a, const Rectangle& b) {
  constexpr double kTouch = 1e-9;
  return a.x0 < b.x1 - kTouch && b.x0 < a.x1 - kTouch && a.y0 < b.y1 - kTouch &&
         b.y0 < a.y1 - kTouch;
}

enum class RoomPurpose { kLiving, kKitchen, kDining, kBedroom, kBath, kOffice, kStorage, kHall };
/// In a word, for people.
const char* name(RoomPurpose purpose);

struct Room {
  RoomPurpose purpose = RoomPurpose::kHall;
  Rectangle area;  ///< from wall to wall; open-plan rooms touch
};

/// A block of wall between two heights [m]: also the piece above a door and below a window.
struct Wall {
  Rectangle area;
  double bottom_m = 0.0;
  double top_m = 2.5;
};

/// A hole in a wall.
struct Opening {
  enum class Kind {
    kDoor,      ///< stands open
    kPassage,   ///< wider, without a door
    kEntrance,  ///< shut
    kWindow,
  };
  Kind kind = Kind::kDoor;
  Rectangle area;  ///< as thick as the wall
  double bottom_m = 0.0;
  double top_m = 2.0;
  int room = 0;         ///< index
  int other_room = -1;  ///< -1: the outside

  double width_m() const;  ///< along the wall
};

/// A box or an upright cylinder of a piece of furniture, in the frame of the piece.
struct FurniturePart {
  Rectangle area;
  double bottom_m = 0.0;
  double top_m = 1.0;
  bool is_round = false;
};

/// A piece of furniture. Its frame: the middle of its footprint, x to where it faces.
struct Furniture {
  std::string name;
  Pose2 T_house_piece;
  double size_x_m = 0.0;  ///< from back to front
  double size_y_m = 0.0;  ///< from side to side
  double size_z_m = 0.0;
  double elevation_m = 0.0;  ///< of its lower side above the floor
  int room = 0;              ///< index
  /// What it is made of, e.g. the top and the legs of a table; never empty.
  std::vector<FurniturePart> parts;

  /// The smallest area along the axes that covers it.
  Rectangle footprint() const;
};

/// One floor. The house frame has its origin at the lower left outer corner.
struct House {
  Rectangle outline;               ///< around the outer walls
  std::vector<Rectangle> notches;  ///< parts of the outline that lie outdoors
  std::vector<Room> rooms;
  std::vector<Opening> openings;
  std::vector<Wall> walls;
  std::vector<Furniture> furniture;
  double ceiling_m = 2.5;

  /// Floor from wall to wall [m2].
  double area_m2() const;
};

/// The heights [m] that something takes up, both ends included.
struct HeightBand {
  double bottom_m;
  double top_m;
};
/// The plane of a LiDAR on a low robot: the legs of tables and chairs are dots, beds, sofas and
/// cupboards are blocks, and so is a low table, which has a shelf there. Of what the generator
/// makes, only seats and desks stand out over what this plane shows.
constexpr HeightBand kLidarPlane{0.2, 0.2};

/// What takes up any height of the band, as a grid in the house frame: walls, shut doors, the
/// outside, and furniture. A piece of furniture that is thinner than a cell takes up the cell of
/// its middle. Throws std::invalid_argument unless `resolution` is finite and positive.
CoarseMap occupancy(const House& house, double resolution, HeightBand band = kLidarPlane);

/// The same without furniture: the floor plan.
CoarseMap walls(const House& house, double resolution);

}  // namespace cmn
