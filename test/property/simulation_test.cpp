// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
// What must hold in every world, under every command.
#include "coarse_map_nav/simulation/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>

#include "simulated_drive.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

CoarseMap random_map(std::mt19937& rng, double occupied_share) {
  std::uniform_real_distribution<double> uniform;
  Grid<std::uint8_t> occupied{30 + static_cast<int>(20 * uniform(rng)), 40};
  for (std::uint8_t& cell : occupied.values()) {
    cell = uniform(rng) < occupied_share;
  }
  return {std::move(occupied), 0.1, {5.0 * uniform(rng), -5.0 * uniform(rng), 6.0 * uniform(rng)}};
}

/// The interval of ways at which a ray is inside [low, high] on one axis.
std::pair<double, double> inside(double at, double direction, double low, double high) {
  if (direction == 0.0) {
    return at >= low && at <= high ? std::pair{-kInfinity, kInfinity} : std::pair{1.0, 0.0};
  }
  const double a = (low - at) / direction;
  const double b = (high - at) / direction;
  return {std::min(a, b), std::max(a, b)};
}

/// The ray against every occupied square, one by one, and against the edge of the map.
double brute_force_cast(const CoarseMap& map, Point2 origin, Point2 direction) {
  const Point2 p = inverse(map.T_map_grid()) * origin;
  const Point2 d = turned(direction, -map.T_map_grid().yaw);
  const double r = map.resolution();
  const auto edge_x = inside(p.x, d.x, 0.0, map.width() * r);
  const auto edge_y = inside(p.y, d.y, 0.0, map.height() * r);
  double least = std::min(edge_x.second, edge_y.second);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (map.is_occupied({x, y})) {
        const auto in_x = inside(p.x, d.x, x * r, (x + 1) * r);
        const auto in_y = inside(p.y, d.y, y * r, (y + 1) * r);
        const double enter = std::max({in_x.first, in_y.first, 0.0});
        if (enter <= std::min(in_x.second, in_y.second)) {
          least = std::min(least, enter);
        }
      }
    }
  }
  return least;
}

double brute_force_clearance(const CoarseMap& map, Point2 point) {
  const Point2 p = inverse(map.T_map_grid()) * point;
  const double r = map.resolution();
  double least =
      std::min(std::min(p.x, map.width() * r - p.x), std::min(p.y, map.height() * r - p.y));
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (map.is_occupied({x, y})) {
        const Point2 q{std::clamp(p.x, x * r, (x + 1) * r), std::clamp(p.y, y * r, (y + 1) * r)};
        least = std::min(least, norm(p - q));
      }
    }
  }
  return least;
}

TEST(SimulationProperty, RayCastAgreesWithEverySquareTriedOneByOne) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 rng{seed};
    const double shares[] = {0.0, 0.002, 0.02, 0.2};
    const CoarseMap map = random_map(rng, shares[seed % 4]);
    const World world{map};
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 100; ++i) {
      const Point2 origin = map.T_map_grid() * Point2{uniform(rng) * map.width() * 0.1,
                                                      uniform(rng) * map.height() * 0.1};
      const double bearing = 2.0 * kPi * uniform(rng);
      const Point2 direction{std::cos(bearing), std::sin(bearing)};
      ASSERT_NEAR(world.cast(origin, direction, 100.0), brute_force_cast(map, origin, direction),
                  1e-9);
    }
  }
}

TEST(SimulationProperty, ContactAgreesWithEverySquareTriedOneByOne) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 rng{seed};
    const CoarseMap map = random_map(rng, 0.02);
    const World world{map};
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 100; ++i) {
      const Point2 p = map.T_map_grid() *
                       Point2{uniform(rng) * map.width() * 0.1, uniform(rng) * map.height() * 0.1};
      const double clearance = brute_force_clearance(map, p);
      const double radius = 0.5 * uniform(rng);
      if (std::abs(clearance - radius) > 1e-9) {
        ASSERT_EQ(world.is_disc_free(p, radius), clearance > radius);
      }
    }
  }
}

TEST(SimulationProperty, TheRobotNeverEntersAWall) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 rng{seed};
    const CoarseMap map = random_map(rng, 0.01);
    World world{map};
    SimulationParams params;
    params.robot.sliding = seed % 2 == 1;
    const auto start = world.random_free_pose(params.robot.radius_m, rng, kPi / 4.0);
    ASSERT_TRUE(start);
    Simulator simulator{std::move(world), params, *start, seed};
    std::uniform_real_distribution<double> uniform{-1.0, 1.0};
    for (int i = 0; i < 8; ++i) {
      const VelocityCommand command{0.8 * uniform(rng), 3.0 * uniform(rng)};
      for (int t = 0; t < 10; ++t) {
        simulator.advance(0.05, command);
        ASSERT_GE(brute_force_clearance(map, simulator.truth().position()),
                  params.robot.radius_m - 1e-9);
      }
    }
  }
}

TEST(SimulationProperty, TheSameCallsFromTheSameSeedGiveTheSameNumbers) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto run = [seed](bool looks) {
      Simulator simulator{empty_hall(10.0), {}, {5.0, 5.0, 0.0}, seed};
      RangeScan scan;
      for (int i = 0; i < 100; ++i) {
        simulator.advance(0.02, {0.3, 0.5});
        if (looks) {
          scan = simulator.scan();
        }
      }
      return std::pair{simulator.truth(), scan.ranges_m};
    };
    const auto once = run(true);
    const auto again = run(true);
    EXPECT_EQ(once.first.x, again.first.x);
    EXPECT_EQ(once.first.yaw, again.first.yaw);
    EXPECT_EQ(once.second, again.second);
    EXPECT_EQ(run(false).first.x, once.first.x) << "looking must not change the driving";
  }
}

// Open loop, 400 seeds. One metre: sqrt(travel_noise^2 + (wheel_slip^2 + travel_bias^2) / 2) =
// 0.0153 m, measured 0.0166. A quarter turn: sqrt(turn_noise^2 pi / 2 + (turn_bias pi / 2)^2) =
// 0.0164 rad (1.04 %), measured 0.0164.
TEST(SimulationProperty, OdometryErrsAsMuchAsItsParametersSay) {
  constexpr int kSeeds = 400;
  double way_squares = 0.0;
  double turn_squares = 0.0;
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    Simulator straight{empty_hall(10.0), {}, {5.0, 5.0, 0.0}, seed};
    while (straight.odometry().T_odom_robot.x < 1.0) {
      straight.advance(0.02, {0.5, 0.0});
    }
    way_squares += std::pow(straight.driven_m() - straight.odometry().T_odom_robot.x, 2);
    Simulator turning{empty_hall(10.0), {}, {5.0, 5.0, 0.0}, seed};
    while (turning.odometry().T_odom_robot.yaw < kPi / 2.0) {
      turning.advance(0.02, {0.0, 1.0});
    }
    turn_squares +=
        std::pow(wrap_angle(turning.truth().yaw - turning.odometry().T_odom_robot.yaw), 2);
  }
  RecordProperty("way", std::to_string(std::sqrt(way_squares / kSeeds)));
  RecordProperty("turn", std::to_string(std::sqrt(turn_squares / kSeeds)));
  EXPECT_NEAR(std::sqrt(way_squares / kSeeds), 0.0153, 0.003);
  EXPECT_NEAR(std::sqrt(turn_squares / kSeeds), 0.0164, 0.003);
}

}  // namespace
}  // namespace cmn
