// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where furniture can stand in one room, with ways left between the doors.
#pragma once

#include "coarse_map_nav/data/grid.hpp"
#include "coarse_map_nav/evaluation/house.hpp"

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

namespace cmn {

/// A side of a room; its walls' normals point into the room.
enum class Side { kEast = 0, kNorth = 1, kWest = 2, kSouth = 3 };

/// Where along a wall a piece wants to stand.
enum class Preference { kAnywhere, kCorner, kMiddle };

/// A piece with its back to a wall.
struct AtWall {
  double width_m = 1.0;   ///< along the wall
  double depth_m = 0.5;   ///< into the room
  double front_m = 0.6;   ///< to be kept free before it
  double beside_m = 0.0;  ///< to be kept free on both sides, behind `beside_from_m`
  double beside_from_m = 0.5;
  bool is_one_side_enough = false;  ///< of those
  bool is_tall = false;             ///< must not hide a window
  Preference preference = Preference::kAnywhere;
};

AtWall against_wall(double width_m, double depth_m, double front_m,
                    Preference preference = Preference::kAnywhere, bool is_tall = false);

/// A place that has been found; the pose is that of a piece which faces away from the wall.
struct WallPlace {
  Side side = Side::kSouth;
  Rectangle area;
  Pose2 pose;
};

/// The state of a room while it is being furnished.
///
/// Furniture takes areas; areas that are kept free (before doors and drawers) take no furniture but
/// may overlap. After each piece there is still a way of `way_m` between all doors and to all
/// places that must be reached; what would block it is refused.
class RoomLayout {
 public:
  RoomLayout(const House& house, int room, double way_m);

  const Rectangle& area() const { return area_; }
  int room() const { return room_; }

  /// Takes an area, keeps others free and makes `must_reach` reachable, or leaves all as it was.
  bool place(const Rectangle& area, const std::vector<Rectangle>& keep_free,
             const std::vector<Point2>& must_reach = {});
  /// Finds a place at a wall and takes it.
  std::optional<WallPlace> place_at_wall(std::mt19937_64& rng, const AtWall& piece);
  /// How much of the floor that nothing stands on can be walked to from the first door.
  double walkable_share() const;
  /// Whether an area is within the room and neither taken nor to be kept free.
  bool is_vacant(const Rectangle& area) const;
  /// The longest stretch of a wall where nothing stands and nothing is kept free, up to `depth_m`
  /// from it; as wide as that, or empty.
  std::optional<WallPlace> longest_stretch(Side side, double depth_m) const;
  bool has_window(const Rectangle& area) const;
  /// Whether a piece there could lean on the wall: it has no hole behind it.
  bool has_wall(Side side, const Rectangle& area) const;

 private:
  WallPlace at(Side side, double begin, const AtWall& piece) const;
  bool try_at(const WallPlace& place, const AtWall& piece);
  Cell cell_of(Point2 p) const;
  Grid<std::uint8_t> ways() const;
  bool is_walkable() const;

  Rectangle area_;
  int room_;
  double way_m_;
  std::vector<Rectangle> taken_;
  std::vector<Rectangle> kept_free_;
  std::vector<Point2> must_reach_;
  std::vector<Rectangle> windows_;
  std::vector<Rectangle> gaps_;  ///< doors, passages and open sides, 5 cm into the room
};

/// The unit vector into the room.
Point2 normal_of(Side side);

}  // namespace cmn
