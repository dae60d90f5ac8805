// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/simulation/world.hpp"

#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

// One metre a cell.
CoarseMap room() {
  return ascii_map({
      "######",
      "#....#",
      "#..#.#",
      "#....#",
      "######",
  });
}

TEST(World, MeasuresFromThePointToTheFaceOfTheWall) {
  const World world{room()};
  EXPECT_DOUBLE_EQ(world.cast({1.5, 1.5}, {1.0, 0.0}, 10.0), 3.5);
  EXPECT_DOUBLE_EQ(world.cast({1.5, 1.5}, {-1.0, 0.0}, 10.0), 0.5);
  EXPECT_DOUBLE_EQ(world.cast({1.5, 1.5}, {0.0, 1.0}, 10.0), 2.5);
  EXPECT_DOUBLE_EQ(world.cast({1.25, 2.5}, {1.0, 0.0}, 10.0), 1.75);
  EXPECT_NEAR(world.cast({1.5, 1.5}, {std::sqrt(0.5), std::sqrt(0.5)}, 10.0), 2.5 * std::sqrt(2.0),
              1e-12);
}

TEST(World, CastsFromExactlyABorderAlmostAlongIt) {
  // cos(pi / 2) is 6e-17: the ray leaves its column at once and, far away, has not moved across.
  CoarseMap hall = CoarseMap{Grid<std::uint8_t>{40, 40}, 0.05};
  const World world{hall};
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double angle = quarter * kPi / 2.0;
    for (const double sign : {1.0, -1.0}) {
      const Point2 direction{sign * std::cos(angle), sign * std::sin(angle)};
      EXPECT_NEAR(world.cast({1.0, 1.0}, direction, 10.0), 1.0, 1e-9) << angle;
    }
  }
}

TEST(World, SeesNothingBeyondTheReach) {
  const World world{room()};
  EXPECT_TRUE(std::isinf(world.cast({1.5, 1.5}, {1.0, 0.0}, 3.4)));
  EXPECT_DOUBLE_EQ(world.cast({1.5, 1.5}, {1.0, 0.0}, 3.6), 3.5);
}

// Along a border either side may be the one that is hit.
TEST(World, ComesToAnEndAlongTheBorderBetweenCells) {
  std::mt19937 rng{1};
  std::vector<std::string> rows(30, std::string(30, '.'));
  for (std::string& row : rows) {
    for (char& cell : row) {
      cell = rng() % 50 == 0 ? '#' : '.';
    }
  }
  const World world{ascii_map(rows)};
  for (int x = 1; x < 30; ++x) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      SCOPED_TRACE(std::to_string(x) + " " + std::to_string(quarter));
      const double yaw = quarter * kPi / 2.0;  // its sine and cosine miss 0 by about 1e-16
      const Point2 ahead{std::cos(yaw), std::sin(yaw)};
      const Point2 aside{-1e-3 * ahead.y, 1e-3 * ahead.x};
      const Point2 from{static_cast<double>(x), static_cast<double>(x)};
      const double left = world.cast({from.x + aside.x, from.y + aside.y}, ahead, 40.0);
      const double right = world.cast({from.x - aside.x, from.y - aside.y}, ahead, 40.0);
      const double along = world.cast(from, ahead, 40.0);
      EXPECT_TRUE(std::abs(along - left) < 1e-2 || std::abs(along - right) < 1e-2)
          << along << " is neither " << left << " nor " << right;
    }
  }
}

TEST(World, IsSolidInsideWallsAndOutsideOfTheMap) {
  const World world{ascii_map({"..", ".."})};
  EXPECT_DOUBLE_EQ(world.cast({0.5, 0.5}, {1.0, 0.0}, 10.0), 1.5) << "the edge is a wall";
  EXPECT_EQ(world.cast({-5.0, 0.5}, {1.0, 0.0}, 10.0), 0.0);
  EXPECT_FALSE(world.is_free({-5.0, 0.5}));
  EXPECT_FALSE(world.is_free({1e6, -1e6}));
  EXPECT_TRUE(world.is_free({0.5, 0.5}));
  EXPECT_TRUE(world.is_free({1.999, 0.001}));
}

TEST(World, FitsADiscThatJustFits) {
  const World world{room()};
  EXPECT_TRUE(world.is_disc_free({1.5, 2.5}, 0.499));
  EXPECT_FALSE(world.is_disc_free({1.5, 2.5}, 0.501));
  // The corner of the pillar at (3, 2): a disc fits diagonally where a square would not.
  EXPECT_TRUE(world.is_disc_free({2.5, 1.5}, 0.499));
  const double to_corner = std::hypot(0.4, 0.4);
  EXPECT_TRUE(world.is_disc_free({2.6, 1.6}, to_corner - 1e-9));
  EXPECT_FALSE(world.is_disc_free({2.6, 1.6}, to_corner + 1e-9));
}

TEST(World, NamesTheNearestPointOfAnObstacle) {
  const World world{room()};
  const auto contact = world.nearest_obstacle({1.2, 1.6}, 0.5);
  ASSERT_TRUE(contact);
  EXPECT_DOUBLE_EQ(contact->x, 1.0);
  EXPECT_DOUBLE_EQ(contact->y, 1.6);
  EXPECT_FALSE(world.nearest_obstacle({1.2, 1.6}, 0.19));
}

TEST(World, LiesWhereTheMapSaysAtAnyAngle) {
  const Pose2 T_map_grid{-3.0, 7.0, 0.7};
  const World plain{room()};
  const World moved{ascii_map({"######", "#....#", "#..#.#", "#....#", "######"}, 1.0, T_map_grid)};
  for (double bearing = -3.0; bearing < 3.0; bearing += 0.1) {
    const Point2 direction{std::cos(bearing), std::sin(bearing)};
    EXPECT_NEAR(moved.cast(T_map_grid * Point2{1.7, 1.4}, turned(direction, 0.7), 10.0),
                plain.cast({1.7, 1.4}, direction, 10.0), 1e-9);
  }
}

TEST(World, DrawsStartsFromTheLargestRegionOnly) {
  const World world{ascii_map({
      "#########",
      "#..#....#",
      "#..#....#",
      "#..#....#",
      "#########",
  })};
  std::mt19937 rng{1};
  std::set<int> quarters;
  for (int i = 0; i < 200; ++i) {
    const auto pose = world.random_free_pose(0.4, rng);
    ASSERT_TRUE(pose);
    EXPECT_GT(pose->x, 4.0);
    EXPECT_TRUE(world.is_disc_free(pose->position(), 0.4));
    EXPECT_NEAR(residual_yaw(*pose), 0.0, 1e-12);
    quarters.insert(index(nearest_heading(pose->yaw)));
  }
  EXPECT_EQ(quarters.size(), 4U);
}

TEST(World, PutsAStartOffTheAxisByNoMoreThanAsked) {
  const World world{room()};
  std::mt19937 rng{1};
  double largest = 0.0;
  for (int i = 0; i < 200; ++i) {
    largest = std::max(largest, std::abs(residual_yaw(*world.random_free_pose(0.2, rng, 0.1))));
  }
  EXPECT_LE(largest, 0.1);
  EXPECT_GT(largest, 0.08);
}

TEST(World, SaysSoWhenTheRobotFitsNowhere) {
  const World world{room()};
  std::mt19937 rng{1};
  EXPECT_FALSE(world.random_free_pose(2.0, rng));
  EXPECT_FALSE(World{ascii_map({"##", "##"})}.random_free_pose(0.1, rng));
}

}  // namespace
}  // namespace cmn
