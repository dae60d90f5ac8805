// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/smooth_warp.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <cmath>
#include <stdexcept>

namespace cmn {
namespace {

constexpr double kSteepest = 0.95;
constexpr double kExact = 1e-10;  // [m]
constexpr int kNewtonSteps = 20;
constexpr int kAxisWaves = 4;  // along each axis, and as many that bend
constexpr double kLean = 0.3;  // [rad] the waves stray from the axes by up to this

double dot(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }

}  // namespace

std::pair<double, double> Jacobian2::stretches() const {
  // With a = (rotation, scale) and b = (reflection, scale): the singular values are |a| +- |b|.
  const double a = std::hypot(xx + yy, yx - xy) / 2.0;
  const double b = std::hypot(xx - yy, yx + xy) / 2.0;
  return {std::abs(a - b), a + b};
}

double Jacobian2::rotation() const { return std::atan2(yx - xy, xx + yy); }

SmoothWarp::SmoothWarp(std::vector<Wave> waves) : waves_{std::move(waves)} {
  if (!(slope_bound() < kSteepest)) {
    throw std::invalid_argument("the waves of a warp are so steep that it could fold");
  }
}

SmoothWarp SmoothWarp::scaled(double factor) const {
  std::vector<Wave> waves = waves_;
  for (Wave& wave : waves) {
    wave.shift_m = factor * wave.shift_m;
  }
  return SmoothWarp{std::move(waves)};
}

Point2 SmoothWarp::operator()(Point2 p) const {
  Point2 q = p;
  for (const Wave& wave : waves_) {
    q = q + std::sin(dot(wave.per_metre, p) + wave.phase) * wave.shift_m;
  }
  return q;
}

Jacobian2 SmoothWarp::jacobian(Point2 p) const {
  Jacobian2 j;
  for (const Wave& wave : waves_) {
    const double c = std::cos(dot(wave.per_metre, p) + wave.phase);
    j.xx += c * wave.shift_m.x * wave.per_metre.x;
    j.xy += c * wave.shift_m.x * wave.per_metre.y;
    j.yx += c * wave.shift_m.y * wave.per_metre.x;
    j.yy += c * wave.shift_m.y * wave.per_metre.y;
  }
  return j;
}

Point2 SmoothWarp::inverse(Point2 q) const {
  if (waves_.empty()) {
    return q;
  }
  Point2 p = q;
  Point2 miss = q - (*this)(p);
  for (int i = 0; i < kNewtonSteps && norm(miss) > kExact; ++i) {
    const Jacobian2 j = jacobian(p);
    const double det = j.determinant();
    const Point2 next =
        p + Point2{(j.yy * miss.x - j.xy * miss.y) / det, (j.xx * miss.y - j.yx * miss.x) / det};
    const Point2 next_miss = q - (*this)(next);
    // The fixed-point step always comes nearer, by the slope's bound at least.
    p = norm(next_miss) < 0.5 * norm(miss) ? next : p + miss;
    miss = q - (*this)(p);
  }
  while (norm(miss) > kExact) {
    p = p + miss;
    miss = q - (*this)(p);
  }
  return p;
}

double SmoothWarp::slope_bound() const {
  double bound = 0.0;
  for (const Wave& wave : waves_) {
    bound += norm(wave.shift_m) * norm(wave.per_metre);
  }
  return bound;
}

SmoothWarp draw_warp(std::mt19937_64& rng, double slope, double shortest_m, double bend) {
  std::vector<SmoothWarp::Wave> waves;
  for (int i = 0; i < 3 * kAxisWaves; ++i) {
    const bool bends = i >= 2 * kAxisWaves;
    const double lean = bends ? (2.0 * draw_uniform(rng) - 1.0) * kPi / 4.0
                              : (2.0 * draw_uniform(rng) - 1.0) * kLean;
    const double direction = (i % 2) * kPi / 2.0 + lean;
    const double wave_number = 2.0 * kPi / (shortest_m * (1.0 + draw_uniform(rng)));
    const double share = bends ? bend / kAxisWaves : (1.0 - bend) / (2 * kAxisWaves);
    const Point2 shift =
        turned({slope * share / wave_number, 0.0}, (i % 2) * kPi / 2.0 + (bends ? kPi / 2.0 : 0.0));
    waves.push_back({turned({wave_number, 0.0}, direction), shift, 2.0 * kPi * draw_uniform(rng)});
  }
  return SmoothWarp{std::move(waves)};
}

}  // namespace cmn
