// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/route_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "ascii_map.hpp"
#include "file_fixture.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kRadius_m = 0.18;

bool anywhere(Point2 /*goal*/) { return true; }

/// Way along axes and diagonals over free ground.
double octile_m(Point2 from, Point2 to) {
  const double dx = std::abs(to.x - from.x);
  const double dy = std::abs(to.y - from.y);
  return std::max(dx, dy) + (1.414 - 1.0) * std::min(dx, dy);
}

/// Dijkstra with an ordinary queue over the same grid of 0.1 m, in metres of the world; a map whose
/// grid frame is the world's.
double oracle_m(const World& world, const CoarseMap& map, Point2 from, Point2 to) {
  const int width = static_cast<int>(std::lround(map.width() * map.resolution() / 0.1));
  const int height = static_cast<int>(std::lround(map.height() * map.resolution() / 0.1));
  const auto is_free = [&](Cell c) {
    return c.x >= 0 && c.y >= 0 && c.x < width && c.y < height &&
           world.is_disc_free({0.1 * (c.x + 0.5), 0.1 * (c.y + 0.5)}, kRadius_m);
  };
  const auto cell_of = [](Point2 p) {
    return Cell{static_cast<int>(std::floor(p.x / 0.1)), static_cast<int>(std::floor(p.y / 0.1))};
  };
  Grid<double> way{width, height, std::numeric_limits<double>::infinity()};
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  way(cell_of(from)) = 0.0;
  open.emplace(0.0, way.index_of(cell_of(from)));
  while (!open.empty()) {
    const auto [cost, i] = open.top();
    open.pop();
    const Cell c = way.cell_at(i);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const double step = 0.1 * (dx != 0 && dy != 0 ? 1.414 : 1.0);
        const Cell next = c + Cell{dx, dy};
        if (is_free(next) && is_free({c.x, next.y}) && is_free({next.x, c.y}) &&
            cost + step < way(next) - 1e-12) {
          way(next) = cost + step;
          open.emplace(way(next), way.index_of(next));
        }
      }
    }
  }
  return way(cell_of(to));
}

TEST(RouteSampler, TheWayThroughAnEmptyHallIsTheStraightOne) {
  const CoarseMap map = ascii_map(std::vector<std::string>(8, std::string(12, '.')));
  const World world{map};
  const RouteSampler sampler{world, map, kRadius_m};
  std::mt19937_64 rng{1};
  for (int i = 0; i < 50; ++i) {
    const auto route = sampler.sample(1.0, 20.0, anywhere, rng);
    ASSERT_TRUE(route);
    EXPECT_NEAR(route->shortest_m, octile_m(route->T_world_start.position(), route->goal_world),
                1e-4);
  }
}

TEST(RouteSampler, TheWayAroundAWallIsTheOneByHand) {
  // A wall from the left, and a gap of 1 m at the right. A disc of 0.18 m stands on the middles of
  // 0.1 m cells up to y = 0.75 below the wall, from 2.25 above it, from x = 4.25 beside it.
  const CoarseMap map = ascii_map({".....", "####.", "....."});
  const World world{map};
  const RouteSampler sampler{world, map, kRadius_m};
  std::mt19937_64 rng{2};
  int crossings = 0;
  for (int i = 0; i < 200; ++i) {
    const auto route = sampler.sample(1.0, 20.0, anywhere, rng);
    ASSERT_TRUE(route);
    Point2 low = route->T_world_start.position();
    Point2 high = route->goal_world;
    if (low.y > high.y) {
      std::swap(low, high);
    }
    if (low.x < 3.5 && high.x < 3.5 && low.y < 0.8 && high.y > 2.2) {
      ++crossings;
      // Below the wall to x = 4.15, a diagonal to 4.25, up to 2.15, a diagonal back to 4.15, on.
      const double by_hand =
          octile_m(low, {4.15, 0.75}) + 0.1414 + 1.3 + 0.1414 + octile_m({4.15, 2.25}, high);
      EXPECT_NEAR(route->shortest_m, by_hand, 1e-4);
    }
  }
  EXPECT_GT(crossings, 20);
}

TEST(RouteSampler, LengthsAreThoseOfAnOrdinaryDijkstra) {
  const CoarseMap map = ascii_map({".....#..", ".##...#.", ".#..#.#.", "...##...", "##....#."});
  const World world{map};
  const RouteSampler sampler{world, map, kRadius_m};
  std::mt19937_64 rng{3};
  for (int i = 0; i < 25; ++i) {
    SCOPED_TRACE("route " + std::to_string(i));
    const auto route = sampler.sample(1.0, 20.0, anywhere, rng);
    ASSERT_TRUE(route);
    EXPECT_NEAR(route->shortest_m,
                oracle_m(world, map, route->T_world_start.position(), route->goal_world), 1e-4);
  }
}

TEST(RouteSampler, StartsAndGoalsAreDrivableAsFarApartAsAskedAndAlongTheAxes) {
  // The room at the right cannot be reached; the frame is shifted and turned.
  const Pose2 T_world_grid{3.0, -2.0, 0.5};
  const CoarseMap map = ascii_map({"......#.", "..##..#.", "......#."}, 1.0, T_world_grid);
  const World world{map};
  const RouteSampler sampler{world, map, kRadius_m};
  std::mt19937_64 rng{4};
  for (int i = 0; i < 100; ++i) {
    const auto route = sampler.sample(2.0, 4.5, anywhere, rng);
    ASSERT_TRUE(route);
    EXPECT_TRUE(world.is_disc_free(route->T_world_start.position(), kRadius_m));
    EXPECT_TRUE(world.is_disc_free(route->goal_world, kRadius_m));
    EXPECT_GE(route->shortest_m, 2.0);
    EXPECT_LE(route->shortest_m, 4.5);
    EXPECT_LT(map.cell_of(route->T_world_start.position()).x, 6);
    EXPECT_LT(map.cell_of(route->goal_world).x, 6);
    const double off_axis = std::remainder(route->T_world_start.yaw - T_world_grid.yaw, kPi / 2.0);
    EXPECT_NEAR(off_axis, 0.0, 1e-9);
  }
}

TEST(RouteSampler, AllFourHeadingsAndAllOfTheGroundAreDrawn) {
  const CoarseMap map = ascii_map({"......", "......"});
  const World world{map};
  const RouteSampler sampler{world, map, kRadius_m};
  EXPECT_NEAR(sampler.drivable_m2(), 56 * 16 * 0.01, 1e-9);  // 0.25 to 5.75 m and 0.25 to 1.75 m
  std::mt19937_64 rng{5};
  std::vector<int> headings(4, 0);
  std::vector<int> thirds(3, 0);
  for (int i = 0; i < 400; ++i) {
    const auto route = sampler.sample(0.5, 20.0, anywhere, rng);
    ASSERT_TRUE(route);
    ++headings[static_cast<std::size_t>(index(nearest_heading(route->T_world_start.yaw)))];
    ++thirds[static_cast<std::size_t>(route->T_world_start.x / 2.0)];
  }
  for (const int count : headings) {
    EXPECT_NEAR(count, 100, 35);  // four standard deviations of a quarter of 400
  }
  for (const int count : thirds) {
    EXPECT_NEAR(count, 133, 40);
  }
}

TEST(RouteSampler, GoalsMayBeRefusedAndTheSameSeedGivesTheSameRoute) {
  const CoarseMap map = ascii_map({"......", "......"});
  const World world{map};
  const RouteSampler sampler{world, map, kRadius_m};
  const auto on_the_right = [](Point2 goal) { return goal.x > 4.0; };
  std::mt19937_64 rng{6};
  std::mt19937_64 again{6};
  for (int i = 0; i < 30; ++i) {
    const auto route = sampler.sample(0.5, 20.0, on_the_right, rng);
    const auto same = sampler.sample(0.5, 20.0, on_the_right, again);
    ASSERT_TRUE(route && same);
    EXPECT_GT(route->goal_world.x, 4.0);
    EXPECT_EQ(route->goal_world.x, same->goal_world.x);
    EXPECT_EQ(route->T_world_start.yaw, same->T_world_start.yaw);
  }
}

TEST(RouteSampler, WithoutAGoalInRangeThereIsNone) {
  const CoarseMap map = ascii_map({"..."});
  const World world{map};
  const RouteSampler sampler{world, map, kRadius_m};
  std::mt19937_64 rng{7};
  EXPECT_FALSE(sampler.sample(3.0, 20.0, anywhere, rng));
  EXPECT_FALSE(sampler.sample(
      0.5, 20.0, [](Point2) { return false; }, rng));
}

TEST(RouteSampler, AWorldWithoutRoomForTheRobotIsAnError) {
  const CoarseMap full = ascii_map({"###", "###"});
  const CoarseMap narrow = ascii_map({"###", "...", "###"}, 0.3);
  for (const CoarseMap& map : {full, narrow}) {
    const World world{map};
    EXPECT_NE(error_of([&] { RouteSampler(world, map, kRadius_m); }).find("no free space"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace cmn
