// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Cells, headings and planar poses: the one home of the axis rules.
///
/// Metres and radians, REP-103: x to the right (east), y up (north), yaw counter-clockwise from x.
/// Cells count the same way: (0, 0) is the lower left one. Images are flipped where they are read.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace cmn {

constexpr double kPi = 3.14159265358979323846;

/// A cell of a grid, or the offset between two cells.
struct Cell {
  int x = 0;
  int y = 0;
};
constexpr bool operator==(Cell a, Cell b) { return a.x == b.x && a.y == b.y; }
constexpr bool operator!=(Cell a, Cell b) { return !(a == b); }
constexpr Cell operator+(Cell a, Cell b) { return {a.x + b.x, a.y + b.y}; }
constexpr Cell operator-(Cell a, Cell b) { return {a.x - b.x, a.y - b.y}; }
constexpr Cell operator*(int k, Cell a) { return {k * a.x, k * a.y}; }

/// One of the four cardinal directions; yaw = index * pi / 2.
enum class Heading : std::uint8_t { kEast = 0, kNorth = 1, kWest = 2, kSouth = 3 };
constexpr std::array<Heading, 4> kHeadings{Heading::kEast, Heading::kNorth, Heading::kWest,
                                           Heading::kSouth};

constexpr int index(Heading h) { return static_cast<int>(h); }
/// The heading after `quarter_turns` turns to the left; any sign, any size.
constexpr Heading turned(Heading h, int quarter_turns) {
  return static_cast<Heading>((((index(h) + quarter_turns) % 4) + 4) % 4);
}
constexpr double yaw(Heading h) { return index(h) * kPi / 2.0; }
/// The cell one ahead, as an offset.
constexpr Cell unit_step(Heading h) {
  constexpr std::array<Cell, 4> kSteps{Cell{1, 0}, Cell{0, 1}, Cell{-1, 0}, Cell{0, -1}};
  return kSteps[static_cast<std::size_t>(index(h))];
}
/// `c` turned about the origin by `quarter_turns` quarter turns to the left.
constexpr Cell turned(Cell c, int quarter_turns) {
  const int q = ((quarter_turns % 4) + 4) % 4;
  return q == 0 ? c : q == 1 ? Cell{-c.y, c.x} : q == 2 ? Cell{-c.x, -c.y} : Cell{c.y, -c.x};
}

/// The same angle in (-pi, pi].
inline double wrap_angle(double angle_rad) {
  // Within a turn and a half the remainder is an exact difference, for a tenth of the time.
  const double size = std::abs(angle_rad);
  const double wrapped = size <= kPi         ? angle_rad
                         : size <= 3.0 * kPi ? angle_rad - std::copysign(2.0 * kPi, angle_rad)
                                             : std::remainder(angle_rad, 2.0 * kPi);
  return wrapped <= -kPi ? wrapped + 2.0 * kPi : wrapped;
}

/// The number of quarter turns (not reduced modulo 4) nearest to a yaw.
inline int nearest_quarter(double yaw_rad) {
  return static_cast<int>(std::lround(yaw_rad / (kPi / 2.0)));
}
inline Heading nearest_heading(double yaw_rad) {
  return turned(Heading::kEast, nearest_quarter(yaw_rad));
}

/// A point of the plane [m].
struct Point2 {
  double x = 0.0;
  double y = 0.0;
};
constexpr Point2 operator+(Point2 a, Point2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Point2 operator*(double k, Point2 a) { return {k * a.x, k * a.y}; }
inline double norm(Point2 a) { return std::hypot(a.x, a.y); }
/// The middle of a cell, in cells.
constexpr Point2 middle_of(Cell c) { return {c.x + 0.5, c.y + 0.5}; }
/// `p` turned about the origin by `angle_rad` to the left.
inline Point2 turned(Point2 p, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

/// A rigid motion of the plane, or the pose of a frame: `T_a_b` takes coordinates in b to a.
struct Pose2 {
  double x = 0.0;    ///< [m]
  double y = 0.0;    ///< [m]
  double yaw = 0.0;  ///< [rad]

  constexpr Point2 position() const { return {x, y}; }
};
/// T_a_c = T_a_b * T_b_c.
inline Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c) {
  const Point2 p = T_a_b.position() + turned(T_b_c.position(), T_a_b.yaw);
  return {p.x, p.y, wrap_angle(T_a_b.yaw + T_b_c.yaw)};
}
/// The coordinates in a of a point given in b.
inline Point2 operator*(const Pose2& T_a_b, Point2 p_b) {
  return T_a_b.position() + turned(p_b, T_a_b.yaw);
}
inline Pose2 inverse(const Pose2& T_a_b) {
  const Point2 p = turned({-T_a_b.x, -T_a_b.y}, -T_a_b.yaw);
  return {p.x, p.y, wrap_angle(-T_a_b.yaw)};
}

/// A planar motion seen from the odometry axis nearest to the robot's heading when it began.
///
/// Robb keeps the robot on the odometry's cardinal axes. A motion is then exactly one of the three
/// actions; between the axes the same description holds for any motion whatever.
struct Displacement {
  double forward_m = 0.0;  ///< along that axis
  double left_m = 0.0;     ///< across it
  int quarter_turns = 0;   ///< how far the nearest axis moved on, left positive, in {-1, 0, 1, 2}
};
/// The motion between two poses in the odometry frame.
inline Displacement displacement(const Pose2& T_odom_from, const Pose2& T_odom_to) {
  const int q_from = nearest_quarter(T_odom_from.yaw);
  const int q_to = nearest_quarter(T_odom_to.yaw);
  const Point2 d = turned(T_odom_to.position() - T_odom_from.position(), -q_from * kPi / 2.0);
  const int turns = (((q_to - q_from) % 4) + 4) % 4;
  return {d.x, d.y, turns == 3 ? -1 : turns};
}
/// The yaw left over towards the nearest odometry axis, in [-pi/4, pi/4].
inline double residual_yaw(const Pose2& T_odom_robot) {
  return wrap_angle(T_odom_robot.yaw - nearest_quarter(T_odom_robot.yaw) * kPi / 2.0);
}

}  // namespace cmn
