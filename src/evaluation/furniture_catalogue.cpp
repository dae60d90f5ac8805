// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/furniture_catalogue.hpp"

#include <initializer_list>

namespace cmn {
namespace {

Furniture piece(const std::string& name, const Pose2& pose, double x, double y, double z) {
  Furniture made;
  made.name = name;
  made.T_house_piece = pose;
  made.size_x_m = x;
  made.size_y_m = y;
  made.size_z_m = z;
  return made;
}

/// Around a point of the piece's frame.
Rectangle around(Point2 middle, double x, double y) {
  return {middle.x - 0.5 * x, middle.y - 0.5 * y, middle.x + 0.5 * x, middle.y + 0.5 * y};
}

void add_legs(Furniture& made, double thickness, double height) {
  for (const double sx : {-0.5, 0.5}) {
    for (const double sy : {-0.5, 0.5}) {
      made.parts.push_back(
          {around({sx * (made.size_x_m - thickness), sy * (made.size_y_m - thickness)}, thickness,
                  thickness),
           0.0, height});
    }
  }
}

}  // namespace

Furniture block(const std::string& name, const Pose2& pose, double size_x_m, double size_y_m,
                double size_z_m, double elevation_m, bool is_round) {
  Furniture made = piece(name, pose, size_x_m, size_y_m, size_z_m);
  made.elevation_m = elevation_m;
  made.parts = {{around({}, size_x_m, size_y_m), elevation_m, elevation_m + size_z_m, is_round}};
  return made;
}

Furniture table(const std::string& name, const Pose2& pose, double size_x_m, double size_y_m,
                double size_z_m) {
  Furniture made = piece(name, pose, size_x_m, size_y_m, size_z_m);
  made.parts = {{around({}, size_x_m, size_y_m), size_z_m - 0.04, size_z_m}};
  add_legs(made, 0.06, size_z_m - 0.04);
  return made;
}

Furniture coffee_table(const Pose2& pose, double size_x_m, double size_y_m) {
  Furniture made = table("coffee table", pose, size_x_m, size_y_m, 0.42);
  made.parts.push_back({around({}, size_x_m, size_y_m), 0.15, 0.22});
  return made;
}

Furniture desk(const Pose2& pose, double size_x_m, double size_y_m) {
  Furniture made = piece("desk", pose, size_x_m, size_y_m, 0.74);
  made.parts = {{around({}, size_x_m, size_y_m), 0.7, 0.74}};
  for (const double side : {-0.5, 0.5}) {
    const double thickness = side < 0.0 ? 0.05 : 0.4;  // on the left a chest of drawers
    made.parts.push_back(
        {around({0.0, side * (size_y_m - thickness)}, size_x_m, thickness), 0.0, 0.7});
  }
  return made;
}

Furniture chair(const Pose2& pose) {
  constexpr double kSize = 0.44;
  Furniture made = piece("chair", pose, kSize, kSize, 0.9);
  made.parts = {{around({}, kSize, kSize), 0.42, 0.46},
                {around({-0.5 * kSize + 0.02, 0.0}, 0.04, kSize), 0.46, 0.9}};
  add_legs(made, 0.04, 0.42);
  return made;
}

Furniture office_chair(const Pose2& pose) {
  Furniture made = piece("office chair", pose, 0.55, 0.55, 1.0);
  made.parts = {{around({}, 0.5, 0.5), 0.0, 0.2, true},
                {around({}, 0.07, 0.07), 0.2, 0.45, true},
                {around({}, 0.5, 0.5), 0.45, 0.55, true},
                {around({-0.25, 0.0}, 0.05, 0.4), 0.55, 1.0}};
  return made;
}

Furniture sofa(const std::string& name, const Pose2& pose, double size_x_m, double size_y_m) {
  Furniture made = piece(name, pose, size_x_m, size_y_m, 0.8);
  made.parts = {{around({}, size_x_m, size_y_m), 0.05, 0.42},
                {around({-0.5 * size_x_m + 0.11, 0.0}, 0.22, size_y_m), 0.42, 0.8}};
  for (const double side : {-0.5, 0.5}) {
    made.parts.push_back(
        {around({0.11, side * (size_y_m - 0.16)}, size_x_m - 0.22, 0.16), 0.42, 0.6});
  }
  return made;
}

Furniture bed(const std::string& name, const Pose2& pose, double size_x_m, double size_y_m) {
  Furniture made = piece(name, pose, size_x_m, size_y_m, 0.95);
  made.parts = {{around({}, size_x_m, size_y_m), 0.05, 0.5},
                {around({-0.5 * size_x_m + 0.03, 0.0}, 0.06, size_y_m), 0.5, 0.95}};
  return made;
}

Furniture toilet(const Pose2& pose) {
  Furniture made = piece("toilet", pose, 0.68, 0.38, 0.8);
  made.parts = {{around({-0.24, 0.0}, 0.2, 0.38), 0.0, 0.8},
                {around({0.05, 0.0}, 0.58, 0.36), 0.0, 0.42, true}};
  return made;
}

}  // namespace cmn
