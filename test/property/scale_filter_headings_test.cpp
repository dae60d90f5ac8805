// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The whole-range filter with 8 headings against a second one, written state by state.
#include "coarse_map_nav/localization/scale_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "random_case.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

/// In cells of which no ray hits a border: rounding would decide there.
LocalOccupancy random_look(std::mt19937_64& rng) {
  LocalOccupancy seen{40, 0.19};
  for (std::size_t i = 0; i < seen.cell_count(); ++i) {
    seen.occupancy[i] = draw_uniform(rng) < 0.05 ? 1.0F : 0.0F;
    seen.confidence[i] = draw_uniform(rng) < 0.02 ? 0.0F : 1.0F;
  }
  return seen;
}

Cell rounded(Point2 p) {
  return {static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y))};
}

/// P(direction, cell), the nominal scale alone; no compass, no supports, no layers, no floats. Of a
/// drawing that is cut already.
class Exhaustive {
 public:
  static constexpr int kDirections = 8;

  Exhaustive(const CoarseMap& map, const ScaleFilterParams& params)
      : map_{map},
        params_{params},
        table_{map, code_},
        field_{map, params.reach_m, params.field_sigma_m, params.field_random} {
    for (auto& layer : p_) {
      layer.assign(map.occupied().size(), 0.0);
      for (std::size_t i = 0; i < layer.size(); ++i) {
        const Cell c = map.occupied().cell_at(i);
        layer[i] = !may_stand(c) ? 0.0 : map.is_free(c) ? 1.0 : params.rim_penalty;
      }
    }
    normalise();
  }
  void update(const LocalOccupancy& seen, const Pose2& T_odom_robot) {
    double news = 1.0;
    Point2 driven;
    if (has_looked_) {
      driven = T_odom_robot.position() - p_odom_last_;
      news = std::min(1.0, norm(driven) / params_.independence_m);
    }
    has_looked_ = true;
    p_odom_last_ = T_odom_robot.position();
    for (int d = 0; d < kDirections; ++d) {
      move(d, turned(driven, angle_of(d)));
      if (news > 0.0) {
        look(d, cast_rays(seen, T_odom_robot.yaw + angle_of(d), params_.reach_m), news);
      }
    }
    normalise();
  }
  /// How the drawing lies: a robot that faces `yaw` in the odometry faces yaw + angle on it.
  static double angle_of(int d) { return d * 2.0 * kPi / kDirections; }
  double at(int d, Cell c) const {
    return p_[static_cast<std::size_t>(d)][map_.occupied().index_of(c)];
  }

 private:
  std::size_t padded(Cell c) const {
    return static_cast<std::size_t>((c.y + 1) * (map_.width() + 2) + c.x + 1);
  }
  bool may_stand(Cell c) const { return map_.contains(c) && table_.may_stand(padded(c)); }

  void move(int d, Point2 driven_m) {
    auto& p = p_[static_cast<std::size_t>(d)];
    Point2& offset = offset_[static_cast<std::size_t>(d)];
    offset = offset + (1.0 / map_.resolution()) * driven_m;
    const Cell whole = rounded(offset);
    offset = offset - Point2{static_cast<double>(whole.x), static_cast<double>(whole.y)};
    std::vector<double> next(p.size(), 0.0);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Cell from = map_.occupied().cell_at(i);
      const Cell to = from + whole;
      const bool may_go = may_stand(to);
      next[map_.occupied().index_of(may_go ? to : from)] +=
          p[i] * (may_go ? 1.0 : params_.blocked_share);
    }
    const double share = std::min(0.2, params_.diffusion * norm(driven_m));
    std::vector<double> spread(p.size(), 0.0);
    for (std::size_t i = 0; i < p.size(); ++i) {
      double stays = next[i];
      for (const Heading h : kHeadings) {
        const Cell to = map_.occupied().cell_at(i) + unit_step(h);
        if (may_stand(to)) {
          spread[map_.occupied().index_of(to)] += share * next[i];
          stays -= share * next[i];
        }
      }
      spread[i] += stays;
    }
    p = spread;
  }

  void look(int d, const RayProfile& rays, double news) {
    auto& p = p_[static_cast<std::size_t>(d)];
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (p[i] > 0.0) {
        p[i] *= std::exp(news * log_likelihood(d, rays, map_.occupied().cell_at(i)));
      }
    }
  }

  double log_likelihood(int d, const RayProfile& rays, Cell c) const {
    const Point2 offset = offset_[static_cast<std::size_t>(d)];
    double range = 0.0;
    double hits = 0.0;
    double frees = 0.0;
    double known = 0.0;
    double hit_count = 0.0;
    double free_count = 0.0;
    const int cap = code_.coded(params_.reach_m);
    for (int b = 0; b < kBearings; ++b) {
      const Ray& ray = rays[static_cast<std::size_t>(b)];
      if (!ray.is_known()) {
        continue;
      }
      ++known;
      const int expected = std::min<int>(table_.row(padded(c))[b], cap);
      const int error = code_.coded(ray.range_m) - expected;
      const double off = code_.step() * error / params_.range_sigma;
      const double match = std::exp(-0.5 * off * off);
      const double likelihood = ray.is_hit  ? match + (error < 0 ? params_.range_short : 0.0)
                                : error < 0 ? 1.0 + params_.range_short
                                            : match;
      range += std::log(likelihood + params_.range_random);
      const auto place_at = [&](double range_m) {
        const Point2 ahead = turned(Point2{1.0, 0.0}, bearing_rad(b));
        return field_.index_of(c + rounded(offset + (range_m / map_.resolution()) * ahead));
      };
      if (ray.is_hit) {
        hits += static_cast<double>(field_.log_hit(place_at(ray.range_m)));
        ++hit_count;
      }
      // Every other bearing of those that the filter counts from its own axes.
      if ((b - bearings_of(d) + kBearings) % 2 == 0) {
        for (const double share : {0.3, 0.6, 0.85}) {
          frees += static_cast<double>(field_.occupied(place_at(share * ray.range_m)));
          ++free_count;
        }
      }
    }
    return params_.range_weight * range / std::max(1.0, known) +
           params_.field_weight * hits / std::max(1.0, hit_count) -
           params_.free_weight * frees / std::max(1.0, free_count) +
           (map_.is_free(c) ? 0.0 : std::log(params_.rim_penalty + 1e-9));
  }
  /// By how many bearings the whole quarter turns of a direction are off.
  static int bearings_of(int d) { return kBearingsPerQuarter * (d / 2); }

  void normalise() {
    double sum = 0.0;
    for (const auto& layer : p_) {
      for (const double p : layer) {
        sum += p;
      }
    }
    for (auto& layer : p_) {
      for (double& p : layer) {
        p /= sum;
      }
    }
  }

  CoarseMap map_;
  ScaleFilterParams params_;
  LogRange code_;
  RangeTable table_;
  HitField field_;
  std::array<std::vector<double>, kDirections> p_;
  std::array<Point2, kDirections> offset_{};
  Point2 p_odom_last_;
  bool has_looked_ = false;
};

TEST(ScaleFilterHeadingsProperty, EightAreAsStateByState) {
  constexpr int kCuts = 2;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const CoarseMap map = random_map(rng, 7, 6, 0.2);
    ScaleFilterParams params;
    params.headings = Exhaustive::kDirections;
    params.scales = 1;
    params.compass.enabled = false;
    params.carried_share = 1.0;
    params.part_m = map.resolution() / kCuts;
    ScaleFilter filter{map, params, 0.5};
    ScaleFilterParams in_parts = params;
    in_parts.diffusion *= kCuts * kCuts;  // of the drawing's cells
    const CoarseMap parts = cut(map, kCuts);
    Exhaustive exhaustive{parts, in_parts};
    // Off the axes, so that no ray runs along a border of cells.
    Pose2 T_odom_robot{0.0, 0.0, 0.3};
    for (int i = 0; i < 6; ++i) {
      const LocalOccupancy seen = random_look(rng);
      if (filter.update(seen, T_odom_robot) != Correction::kApplied) {
        break;  // re-opened: not of interest here
      }
      exhaustive.update(seen, T_odom_robot);
      const Belief& belief = filter.localization().belief;
      for (const Heading h : kHeadings) {
        Grid<double> expected{map.width(), map.height()};
        for (std::size_t j = 0; j < parts.occupied().size(); ++j) {
          const Cell part = parts.occupied().cell_at(j);
          for (int d = 0; d < Exhaustive::kDirections; ++d) {
            const double yaw_rad = T_odom_robot.yaw + Exhaustive::angle_of(d);
            expected({part.x / kCuts, part.y / kCuts}) +=
                nearest_heading(yaw_rad) == h ? exhaustive.at(d, part) : 0.0;
          }
        }
        for (std::size_t j = 0; j < expected.size(); ++j) {
          ASSERT_NEAR(belief(h, expected.cell_at(j)), expected[j], 2e-4) << "look " << i;
        }
      }
      T_odom_robot = T_odom_robot * Pose2{0.37 * draw_uniform(rng), 0.05, 0.4 * draw_normal(rng)};
    }
  }
}

TEST(ScaleFilterHeadingsProperty, AnOdometryThatIsTurnedByOneOfThemChangesNothing) {
  for (const int headings : {4, 8, 12, 36}) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      SCOPED_TRACE(std::to_string(headings) + " headings, seed " + std::to_string(seed));
      std::mt19937_64 rng{seed};
      const CoarseMap map = random_map(rng, 8, 6);
      ScaleFilterParams params;
      params.headings = headings;
      params.scales = 2;
      params.compass.enabled = false;
      params.free_weight = 0.0;  // counts every other bearing, from the odometry's axes on
      ScaleFilter filter{map, params, 0.5};
      ScaleFilter other{map, params, 0.5};
      const int by = static_cast<int>(draw_index(rng, static_cast<std::size_t>(headings)));
      const Pose2 turn{0.0, 0.0, by * 2.0 * kPi / headings};
      if (seed % 2 == 0) {
        for (ScaleFilter* each : {&filter, &other}) {
          ASSERT_TRUE(each->reset_near({1.0, 1.0, 2.0}, 2.0, 1.0));
        }
      }
      // In the middle between two of them the first look's rounding would decide.
      Pose2 T_odom_robot{1.0, 2.0, 0.1 / headings};
      for (int i = 0; i < 6; ++i) {
        const LocalOccupancy seen = random_look(rng);
        ASSERT_EQ(filter.update(seen, T_odom_robot), other.update(seen, turn * T_odom_robot));
        const Localization a = filter.localization();
        const Localization b = other.localization();
        for (const Heading h : kHeadings) {
          for (std::size_t j = 0; j < map.occupied().size(); ++j) {
            const Cell c = map.occupied().cell_at(j);
            ASSERT_NEAR(a.belief(h, c), b.belief(h, c), 1e-4) << "look " << i;
          }
        }
        ASSERT_NEAR(a.confidence, b.confidence, 1e-3);
        if (a.estimate == b.estimate) {
          ASSERT_NEAR(wrap_angle(a.yaw_rad - b.yaw_rad), 0.0, 1e-3);
        }
        T_odom_robot = T_odom_robot * Pose2{0.37 * draw_uniform(rng), 0.05, 0.4 * draw_normal(rng)};
      }
    }
  }
}

}  // namespace
}  // namespace cmn
