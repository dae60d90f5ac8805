// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/particle_filter.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "ascii_map.hpp"
#include "random_case.hpp"
#include "wanderer.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kCropCell_m = 1.28 / 3;

LocalizationParams particle_params(int count) {
  LocalizationParams params;
  params.filter = "particle";
  params.particles.count = count;
  return params;
}

LocalizationParams without_noise(int count) {
  LocalizationParams params = particle_params(count);
  params.particles.travel_noise = 0.0;
  params.particles.scale_noise = 0.0;
  params.particles.yaw_noise = 0.0;
  params.particles.renewed_share = 0.0;
  return params;
}

/// What a robot sees that stands at `T_grid_robot` on a building whose cells truly measure
/// `cell_m`: 27 x 27 parts of 1.28 m.
LocalOccupancy view(const CoarseMap& map, double cell_m, const Pose2& T_grid_robot) {
  LocalOccupancy seen{27, 1.28 / 27};
  for (int iy = 0; iy < 27; ++iy) {
    for (int ix = 0; ix < 27; ++ix) {
      const Point2 p =
          T_grid_robot * Point2{(ix - 13) * seen.resolution, (iy - 13) * seen.resolution};
      const Cell c{static_cast<int>(std::floor(p.x / cell_m)),
                   static_cast<int>(std::floor(p.y / cell_m))};
      seen.occupancy[seen.index_of(ix, iy)] = map.is_occupied(c) ? 1.0F : 0.0F;
      seen.confidence[seen.index_of(ix, iy)] = 1.0F;
    }
  }
  return seen;
}

/// A robot that bumps through a building: forward where it can, else a turn.
class Wanderer {
 public:
  Wanderer(const CoarseMap& map, double cell_m, Point2 start_cells, std::uint64_t seed)
      : map_{map}, cell_m_{cell_m}, rng_{seed} {
    T_grid_robot = {start_cells.x * cell_m, start_cells.y * cell_m, 0.0};
  }
  void step() {
    const Pose2 T_ahead = T_grid_robot * Pose2{0.15, 0.0, 0.0};
    const Point2 bow = T_grid_robot * Point2{0.15 + 0.2, 0.0};
    const bool is_free =
        map_.is_free({static_cast<int>(bow.x / cell_m_), static_cast<int>(bow.y / cell_m_)});
    const Pose2 before = T_grid_robot;
    T_grid_robot =
        is_free && draw_uniform(rng_) > 0.1
            ? T_ahead
            : T_grid_robot * Pose2{0.0, 0.0, draw_uniform(rng_) < 0.5 ? kPi / 2 : -kPi / 2};
    T_odom_robot = T_odom_robot * (inverse(before) * T_grid_robot);
  }
  LocalOccupancy look() const { return view(map_, cell_m_, T_grid_robot); }
  Point2 position_cells() const { return (1.0 / cell_m_) * T_grid_robot.position(); }

  Pose2 T_grid_robot;
  Pose2 T_odom_robot;

 private:
  CoarseMap map_;
  double cell_m_;
  std::mt19937_64 rng_;
};

TEST(ParticleFilter, StartsAnywhereOnFreeCellsOfAllHeadings) {
  const CoarseMap map = flat();
  const ParticleFilter filter{map, particle_params(4000)};
  const Localization at = filter.localization();
  EXPECT_NEAR(total(at.belief), 1.0, 1e-12);
  for (const Heading h : kHeadings) {
    double mass = 0.0;
    for (std::size_t i = 0; i < map.occupied().size(); ++i) {
      const double p = at.belief(h, map.occupied().cell_at(i));
      EXPECT_TRUE(map.is_free(map.occupied().cell_at(i)) || p == 0.0);
      mass += p;
    }
    EXPECT_NEAR(mass, 0.25, 1e-9);
  }
  EXPECT_FALSE(at.is_converged);
}

TEST(ParticleFilter, StartsAtAGivenHeadingAndAtMoreThanOneScale) {
  ParticleFilter filter{flat(), particle_params(1000)};
  filter.reset_heading(Heading::kSouth);
  double sum = 0.0;
  double squares = 0.0;
  for (const Particle& particle : filter.particles()) {
    EXPECT_EQ(nearest_heading(particle.yaw), Heading::kSouth);
    sum += std::log(particle.scale);
    squares += std::log(particle.scale) * std::log(particle.scale);
  }
  EXPECT_NEAR(sum / 1000, 0.0, 0.02);  // 3 standard errors of the mean
  EXPECT_NEAR(std::sqrt(squares / 1000), ParticleParams{}.scale_spread, 0.02);
}

TEST(ParticleFilter, MovesEachParticleByTheOdometryOverItsScale) {
  const CoarseMap hall = ascii_map(std::vector<std::string>(60, std::string(60, '.')), 0.5);
  ParticleFilter filter{hall, without_noise(200)};
  const std::vector<Particle> before = filter.particles();
  const Pose2 driven{0.3, 0.1, kPi / 2};
  filter.predict(driven);
  int compared = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Point2 on = before[i].position +
                      (1.0 / (0.5 * before[i].scale)) * turned(driven.position(), before[i].yaw);
    if (hall.is_free({static_cast<int>(std::floor(on.x)), static_cast<int>(std::floor(on.y))})) {
      EXPECT_NEAR(norm(filter.particles()[i].position - on), 0.0, 1e-9);
      ++compared;
    }
    EXPECT_NEAR(wrap_angle(filter.particles()[i].yaw - before[i].yaw - kPi / 2), 0.0, 1e-9);
    EXPECT_EQ(filter.particles()[i].scale, before[i].scale);
  }
  EXPECT_GT(compared, 180);
}

TEST(ParticleFilter, NoParticlePassesAWallHoweverFarItIsDriven) {
  const CoarseMap map = ascii_map({"..........#.........."}, 0.5);
  ParticleFilter filter{map, particle_params(400)};
  filter.reset_heading(Heading::kEast);
  const std::vector<Particle> before = filter.particles();
  filter.predict({20.0, 0.0, 0.0});
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Point2 p = filter.particles()[i].position;
    EXPECT_TRUE(map.is_free({static_cast<int>(p.x), static_cast<int>(p.y)}));
    EXPECT_EQ(before[i].position.x < 10.0, p.x < 10.0);
  }
}

TEST(ParticleFilter, WeighsByTheErrorAtTheParticlesOwnPoseAndScale) {
  const CoarseMap map = flat();
  LocalizationParams params = particle_params(300);
  for (const double exponent : {2.0, 3.0}) {
    params.measurement.exponent = exponent;
    ParticleFilter filter{map, params};
    filter.predict({0.1, 0.0, 0.2});
    std::mt19937_64 rng{3};
    const LocalOccupancy seen = random_observation(rng, 3);
    ASSERT_GT(filter.correct(seen), 0.0);
    std::vector<double> expected;
    double sum = 0.0;
    for (const Particle& particle : filter.particles()) {
      double mse = 0.0;
      for (int iy = 0; iy < 3; ++iy) {
        for (int ix = 0; ix < 3; ++ix) {
          const Point2 p =
              particle.position +
              (1.0 / (particle.scale * map.resolution())) *
                  turned({(ix - 1) * kCropCell_m, (iy - 1) * kCropCell_m}, particle.yaw);
          const Cell c{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))};
          const double error = static_cast<double>(seen.occupancy[seen.index_of(ix, iy)]) -
                               (map.is_occupied(c) ? 1.0 : 0.0);
          mse += error * error / 9.0;
        }
      }
      expected.push_back(std::pow(1.0 - mse, exponent));
      sum += expected.back();
    }
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(filter.particles()[i].weight, expected[i] / sum, 1e-9);
    }
  }
}

TEST(ParticleFilter, AnImpossibleLookIsAContradictionAndReopensTheBelief) {
  const CoarseMap hall = ascii_map(std::vector<std::string>(40, std::string(40, '.')), 1.0);
  LocalizationParams params = without_noise(500);
  params.contradiction_evidence = 0.2;
  params.reopen_after = 3;
  params.reopen_weight = 0.5;
  ParticleFilter filter{hall, params};
  filter.reset_heading(Heading::kNorth);
  LocalOccupancy walled_in{3, kCropCell_m};
  walled_in.occupancy.assign(9, 1.0F);
  walled_in.confidence.assign(9, 1.0F);
  EXPECT_EQ(filter.update(walled_in, {}), Correction::kContradiction);
  EXPECT_EQ(filter.update(walled_in, {}), Correction::kContradiction);
  EXPECT_EQ(filter.update(walled_in, {}), Correction::kReopened);
  EXPECT_EQ(filter.update(walled_in, {}), Correction::kContradiction);
  const Localization at = filter.localization();
  EXPECT_NEAR(total(at.belief), 1.0, 1e-12);
  double elsewhere = 0.0;
  for (const Particle& particle : filter.particles()) {
    elsewhere += nearest_heading(particle.yaw) == Heading::kNorth ? 0.0 : particle.weight;
  }
  EXPECT_NEAR(elsewhere, 0.5 * 0.75, 0.07);  // 3 standard errors of a share of 500
}

TEST(ParticleFilter, HeadingsAreThoseOfTheOdometryAxesHoweverTheRobotWokeUp) {
  ParticleFilter filter{flat(), without_noise(500)};
  filter.reset_heading(Heading::kWest);
  std::mt19937_64 rng{1};
  const double woke_up_rad = 0.7;
  filter.update(random_observation(rng, 9), {0.0, 0.0, woke_up_rad});
  const Localization at = filter.localization();
  EXPECT_EQ(at.estimate.heading, Heading::kWest);
  EXPECT_NEAR(wrap_angle(at.yaw_rad - kPi - woke_up_rad), 0.0, 1e-9);
}

TEST(ParticleFilter, TheSameSeedGivesTheSameParticles) {
  const CoarseMap map = flat();
  LocalizationParams params = particle_params(500);
  std::vector<ParticleFilter> filters(2, ParticleFilter{map, params});
  params.seed = 2;
  filters.emplace_back(map, params);
  std::vector<std::vector<double>> xs;
  for (ParticleFilter& filter : filters) {
    Wanderer robot{map, 0.5, {4.5, 4.5}, 5};
    xs.emplace_back();
    for (int i = 0; i < 30; ++i) {
      filter.update(robot.look(), robot.T_odom_robot);
      robot.step();
    }
    for (const Particle& particle : filter.particles()) {
      xs.back().push_back(particle.position.x);
    }
  }
  EXPECT_EQ(xs[0], xs[1]);
  EXPECT_NE(xs[0], xs[2]);
}

TEST(ParticleFilter, FindsItselfInASmallBuildingOfAnyScale) {
  // N = 30 wanderings of 150 steps, heading known: measured 30 of 30 within 1 m at the end.
  const CoarseMap map = flat();
  int found = 0;
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    const double scale = seed % 3 == 0 ? 0.8 : seed % 3 == 1 ? 1.0 : 1.25;
    LocalizationParams params = particle_params(1000);
    params.seed = seed;
    params.measurement.exponent = 8.0;  // the view is without error
    ParticleFilter filter{map, params};
    filter.reset_heading(Heading::kEast);
    Wanderer robot{map, 0.5 * scale, {2.5, 2.5}, seed};
    for (int i = 0; i < 150; ++i) {
      filter.update(robot.look(), robot.T_odom_robot);
      robot.step();
    }
    filter.update(robot.look(), robot.T_odom_robot);
    const Localization at = filter.localization();
    found += norm(at.position_cells - robot.position_cells()) * 0.5 * scale < 1.0 &&
             at.estimate.heading == nearest_heading(robot.T_grid_robot.yaw);
  }
  EXPECT_GE(found, 27) << "of 30";
}

TEST(ParticleFilter, LearnsTheScaleOfTheDrawing) {
  // N = 10 wanderings of 300 steps at each scale: measured 0.82 and 1.26 on average.
  const CoarseMap map = flat();
  double sum_small = 0.0;
  double sum_large = 0.0;
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    for (const double scale : {0.8, 1.25}) {
      LocalizationParams params = particle_params(1000);
      params.seed = seed;
      params.measurement.exponent = 8.0;
      ParticleFilter filter{map, params};
      filter.reset_heading(Heading::kEast);
      Wanderer robot{map, 0.5 * scale, {2.5, 2.5}, seed};
      double sum = 0.0;
      for (int i = 0; i < 300; ++i) {
        filter.update(robot.look(), robot.T_odom_robot);
        robot.step();
        sum += i >= 200 ? filter.scale() / 100.0 : 0.0;
      }
      (scale < 1.0 ? sum_small : sum_large) += sum / 10.0;
    }
  }
  EXPECT_NEAR(sum_small, 0.8, 0.1);
  EXPECT_NEAR(sum_large, 1.25, 0.15);
}

TEST(ParticleFilterProperty, AnyEpisodeKeepsUnitMassOnFreeCells) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    LocalizationParams params = particle_params(50);
    params.seed = seed;
    params.measurement.window_reach = static_cast<int>(seed % 4);
    ParticleFilter filter{random_map(rng, 3 + static_cast<int>(seed % 9), 7), params};
    Pose2 T_odom_robot;
    for (int i = 0; i < 30; ++i) {
      filter.update(random_observation(rng, 6), T_odom_robot);
      T_odom_robot = T_odom_robot * Pose2{draw_uniform(rng), draw_uniform(rng) - 0.5,
                                          3.0 * draw_uniform(rng) - 1.5};
      const Localization at = filter.localization();
      ASSERT_NEAR(total(at.belief), 1.0, 1e-9);
      ASSERT_TRUE(filter.map().is_free(at.estimate.cell));
      ASSERT_GE(at.confidence, 0.0);
      ASSERT_LE(at.confidence, 1.0 + 1e-9);
      for (const Particle& particle : filter.particles()) {
        ASSERT_TRUE(filter.map().is_free(
            {static_cast<int>(particle.position.x), static_cast<int>(particle.position.y)}));
      }
    }
  }
}

TEST(ParticleFilterProperty, ATurnedDrawingGivesTheTurnedBelief) {
  // In distribution: 100000 particles, so that the mass of a state of p = 0.02 has a standard error
  // of 0.0005 or, after resampling some times, a few times as much.
  std::mt19937_64 rng{4};
  const CoarseMap map = random_map(rng, 7, 5, 0.25);
  const CoarseMap turned_map = turned_left(map);
  LocalizationParams params = particle_params(100000);
  ParticleFilter filter{map, params};
  params.seed = 2;
  ParticleFilter turned_filter{turned_map, params};
  Pose2 T_odom_robot;
  for (int i = 0; i < 6; ++i) {
    const LocalOccupancy seen = random_observation(rng, 3);
    filter.update(seen, T_odom_robot);
    turned_filter.update(seen, T_odom_robot);
    T_odom_robot = T_odom_robot * Pose2{0.15, 0.0, i % 2 == 0 ? kPi / 2 : 0.0};
  }
  for (const Heading h : kHeadings) {
    for (std::size_t i = 0; i < map.occupied().size(); ++i) {
      const Cell c = map.occupied().cell_at(i);
      const Cell c_turned{map.height() - 1 - c.y, c.x};
      EXPECT_NEAR(filter.localization().belief(h, c),
                  turned_filter.localization().belief(turned(h, 1), c_turned), 0.004);
    }
  }
}

}  // namespace
}  // namespace cmn
