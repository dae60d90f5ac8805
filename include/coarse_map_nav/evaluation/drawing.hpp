// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The maps that an evaluation hands to the robot, with the truth about them kept for scoring.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/evaluation/smooth_warp.hpp"
#include "coarse_map_nav/mapping/place_warp.hpp"

#include <cstdint>
#include <memory>
#include <optional>

namespace cmn {

/// A map for the robot, and where the points of the metric world lie on it: this
/// holds in both directions to 1e-6 m, of somebody's drawing near its places. The robot must
/// never see it. Cheap to copy.
class Drawing {
 public:
  /// A map to scale, in the frame of the world.
  explicit Drawing(CoarseMap map);
  /// map point = shift + scale * (warp(world point), turned by `quarter_turns` to the left).
  /// `mean_scale`: map metres a world metre on average, `scale` times the warp's own mean.
  Drawing(CoarseMap map, SmoothWarp warp, double scale, int quarter_turns, Point2 shift,
          double mean_scale);
  /// Of somebody's, see given_drawing(). `guess`: from the map to the world, about.
  Drawing(CoarseMap map, PlaceWarp places, PlaceWarp guess, double mean_scale);

  const CoarseMap& map() const { return content_->map; }
  /// [m] in the world -> [m, nominal] in the frame of the map.
  Point2 world_to_map(Point2 world) const;
  Point2 map_to_world(Point2 map) const;
  /// The heading turns with the rotation that is nearest to the warp at that place.
  Pose2 world_to_map(const Pose2& T_world_robot) const;
  Pose2 map_to_world(const Pose2& T_map_robot) const;

  /// The derivative of world_to_map.
  Jacobian2 jacobian(Point2 world) const;
  /// Nominal map metres a world metre, on average over the free space of the world.
  double scale() const { return content_->mean_scale; }
  /// The drawing is turned by so many quarter turns to the left, 0 to 3.
  int quarter_turns() const { return content_->quarter_turns; }

 private:
  struct Content {
    CoarseMap map;
    SmoothWarp warp;
    double scale = 1.0;
    int quarter_turns = 0;
    Point2 shift;
    double mean_scale = 1.0;
    std::optional<PlaceWarp> places;  ///< in place of warp, scale, turns and shift
    std::optional<PlaceWarp> guess;
  };
  std::shared_ptr<const Content> content_;
};

/// The coarse grid of the CMN paper (downsampled()): a cell of `mpp` metres is occupied when more
/// than half of it is. To scale, in the frame of the world. A generated house's walls: its plan.
///
/// With a clearance, ground counts as occupied where the middle of a disc of that radius [m] cannot
/// be, as on Habitat's maps of Gibson that CMN makes coarse: walls are thicker by the radius on
/// each side. Without it, a wall thinner than half a cell is lost. Throws as downsampled() does.
Drawing coarse_grid(const CoarseMap& world, double mpp, double clearance_m = 0.0);

/// What counts as furniture in a building that nobody has labelled.
struct WallParams {
  double longest_furniture_m = 2.5;
  double gap_m = 1.2;
  double dash_m = 0.2;

  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("longest_furniture_m", self.longest_furniture_m, Between{0.0, 100.0},
          "[m] free-standing obstacles with no side longer are furniture");
    visit("gap_m", self.gap_m, Between{0.0, 10.0},
          "[m] pieces of wall in line with a long wall and no farther from it belong to it");
    visit("dash_m", self.dash_m, Between{0.0, 1.0},
          "[m] a straight wall may have holes up to this, where the LiDAR missed it");
  }
};

/// The world without its free-standing furniture, at its own resolution. What is free in the world
/// stays free; what hangs on the walls or on the unknown outside stays occupied.
CoarseMap without_furniture(const CoarseMap& world, const WallParams& params = {});

/// A floor plan: without_furniture(), as a coarse grid.
Drawing walls_only(const CoarseMap& world, double mpp, double clearance_m = 0.0,
                   const WallParams& params = {});

/// How badly a person draws. Lengths count in the world.
struct HandDrawingParams {
  double stretch = 0.25;
  double stretch_length_m = 8.0;
  double bend = 0.3;
  double smallest_scale = 0.7;
  double largest_scale = 1.4;
  bool turn = true;
  double wobble_m = 0.08;
  double wobble_length_m = 2.0;
  double small_furniture_m = 1.2;
  double dropped_share = 0.5;
  double moved_share = 0.25;
  double move_m = 0.5;
  double walker_radius_m = 0.18;
  double smallest_room_m2 = 1.0;

  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("stretch", self.stretch, Between{0.0, 0.4},
          "[-] how much any length may be too short or too long, beside the scale");
    visit("stretch_length_m", self.stretch_length_m, Between{2.0, 1000.0},
          "[m] the shortest way over which the stretch comes and goes");
    visit("bend", self.bend, Between{0.0, 1.0}, "[-] the share of the stretch that bends walls");
    visit("smallest_scale", self.smallest_scale, Between{0.2, 5.0},
          "[-] least of drawn metres a metre, on average");
    visit("largest_scale", self.largest_scale, Between{0.2, 5.0}, "[-] and most");
    visit("turn", self.turn, Anything{}, "lay the sheet any way, by quarter turns");
    visit("wobble_m", self.wobble_m, Between{0.0, 1.0},
          "[m] how far a line strays from where it belongs");
    visit("wobble_length_m", self.wobble_length_m, Between{0.2, 100.0}, "[m] over which it strays");
    visit("small_furniture_m", self.small_furniture_m, Between{0.0, 10.0},
          "[m] free-standing obstacles with no side longer may be left out or moved");
    visit("dropped_share", self.dropped_share, Between{0.0, 1.0}, "[-] of them left out");
    visit("moved_share", self.moved_share, Between{0.0, 1.0}, "[-] of them moved");
    visit("move_m", self.move_m, Between{0.0, 5.0}, "[m] as far at most");
    visit("walker_radius_m", self.walker_radius_m, Between{0.0, 2.0},
          "[m] gaps that a disc of it does not fit through are drawn closed");
    visit("smallest_room_m2", self.smallest_room_m2, Between{0.0, 100.0},
          "[m2] enclosed free space below is not drawn");
  }
};

/// The world as a person might draw it from memory: out of proportion by a smooth warp, in an
/// unknown scale and an unknown quarter turn, lines wobbly, small furniture left out or moved, and
/// then made coarse by coarsen(), which keeps doors open and walls closed. `mpp` [m] is the nominal
/// size of a cell: it covers mpp / scale() of the world. The grid's lower left corner is the origin
/// of the map frame. The same seed gives the same drawing everywhere.
///
/// What a disc of `walker_radius_m` can reach in the world is one region of the drawing, as far as
/// coarsen() keeps it. Throws std::invalid_argument when parameters contradict each other or `mpp`
/// is finer than the world, std::runtime_error when the world has no room for such a disc.
Drawing hand_drawn(const CoarseMap& world, double mpp, std::uint32_t seed,
                   const HandDrawingParams& params = {});

}  // namespace cmn
