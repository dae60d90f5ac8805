// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/drawing.hpp"

#include "coarse_map_nav/mapping/downsample.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace cmn {
namespace {

// How a PlaceWarp is inverted.
constexpr int kMostSteps = 30;
constexpr double kNear_m = 1e-9;
constexpr double kStep_m = 1e-4;

}  // namespace

Drawing::Drawing(CoarseMap map) : Drawing{std::move(map), SmoothWarp{}, 1.0, 0, {}, 1.0} {}

Drawing::Drawing(CoarseMap map, SmoothWarp warp, double scale, int quarter_turns, Point2 shift,
                 double mean_scale)
    : content_{std::make_shared<const Content>(Content{
          std::move(map), std::move(warp), scale, quarter_turns, shift, mean_scale, {}, {}})} {}

Drawing::Drawing(CoarseMap map, PlaceWarp places, PlaceWarp guess, double mean_scale)
    : content_{std::make_shared<const Content>(Content{
          std::move(map), {}, 1.0, 0, {}, mean_scale, std::move(places), std::move(guess)})} {}

Point2 Drawing::world_to_map(Point2 world) const {
  const Content& c = *content_;
  if (c.places) {
    return c.places->world_to_map(world);
  }
  return c.shift + c.scale * turned(c.warp(world), c.quarter_turns * kPi / 2.0);
}

Point2 Drawing::map_to_world(Point2 map) const {
  const Content& c = *content_;
  if (c.places) {
    // Newton's method.
    Point2 p = c.guess->world_to_map(map);
    for (int i = 0; i < kMostSteps; ++i) {
      const Point2 off = map - world_to_map(p);
      const Jacobian2 j = jacobian(p);
      p = p + (1.0 / j.determinant()) *
                  Point2{j.yy * off.x - j.xy * off.y, j.xx * off.y - j.yx * off.x};
      if (norm(off) < kNear_m) {
        break;
      }
    }
    return p;
  }
  return c.warp.inverse(turned((1.0 / c.scale) * (map - c.shift), -c.quarter_turns * kPi / 2.0));
}

Pose2 Drawing::world_to_map(const Pose2& T_world_robot) const {
  const Point2 p = world_to_map(T_world_robot.position());
  const double turn = jacobian(T_world_robot.position()).rotation();
  return {p.x, p.y, wrap_angle(T_world_robot.yaw + turn)};
}

Pose2 Drawing::map_to_world(const Pose2& T_map_robot) const {
  const Point2 p = map_to_world(T_map_robot.position());
  return {p.x, p.y, wrap_angle(T_map_robot.yaw - jacobian(p).rotation())};
}

Jacobian2 Drawing::jacobian(Point2 world) const {
  const Content& c = *content_;
  if (c.places) {
    const auto slope = [&](Point2 step) {
      return (0.5 / kStep_m) * (world_to_map(world + step) - world_to_map(world - step));
    };
    const Point2 x = slope({kStep_m, 0.0});
    const Point2 y = slope({0.0, kStep_m});
    return {x.x, y.x, x.y, y.y};
  }
  const Jacobian2 j = c.warp.jacobian(world);
  const Point2 x = c.scale * turned(Point2{j.xx, j.yx}, c.quarter_turns * kPi / 2.0);
  const Point2 y = c.scale * turned(Point2{j.xy, j.yy}, c.quarter_turns * kPi / 2.0);
  return {x.x, y.x, x.y, y.y};
}

Drawing coarse_grid(const CoarseMap& world, double mpp, double clearance_m) {
  if (!(clearance_m > 0.0)) {
    return Drawing{downsampled(world, mpp)};
  }
  const World ground{world};
  Grid<std::uint8_t> occupied{world.width(), world.height()};
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    const Point2 p = world.center_of(occupied.cell_at(i));
    occupied[i] = ground.is_disc_free(p, clearance_m) ? 0 : 1;
  }
  const CoarseMap narrowed{std::move(occupied), world.resolution(), world.T_map_grid()};
  return Drawing{downsampled(narrowed, mpp)};
}

Drawing walls_only(const CoarseMap& world, double mpp, double clearance_m,
                   const WallParams& params) {
  return coarse_grid(without_furniture(world, params), mpp, clearance_m);
}

}  // namespace cmn
