// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/house.hpp"

#include "coarse_map_nav/evaluation/furniture_catalogue.hpp"
#include "coarse_map_nav/evaluation/openings.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace cmn {
namespace {

/// Two rooms of 2 m x 2 m side by side, a door between them, a window and an entrance.
House two_rooms() {
  House house;
  house.outline = {0.0, 0.0, 4.5, 2.4};
  house.rooms = {{RoomPurpose::kHall, {0.2, 0.2, 2.2, 2.2}},
                 {RoomPurpose::kOffice, {2.3, 0.2, 4.3, 2.2}}};
  house.openings = {
      {Opening::Kind::kDoor, {2.2, 0.5, 2.3, 1.3}, 0.0, 2.0, 0, 1},
      {Opening::Kind::kWindow, {4.3, 0.5, 4.5, 1.5}, 0.9, 2.0, 1, -1},
      {Opening::Kind::kEntrance, {0.0, 0.5, 0.2, 1.4}, 0.0, 2.0, 0, -1},
  };
  return house;
}

bool is_free(const CoarseMap& map, double x, double y) { return map.is_free(map.cell_of({x, y})); }

TEST(House, ItsWallsAreSolidExceptForOpenDoors) {
  const CoarseMap map = walls(two_rooms(), 0.05);
  EXPECT_EQ(map.width(), 90);
  EXPECT_EQ(map.height(), 48);
  EXPECT_TRUE(is_free(map, 1.0, 1.0));
  EXPECT_TRUE(is_free(map, 3.0, 1.0));
  EXPECT_TRUE(is_free(map, 2.25, 0.9));
  EXPECT_FALSE(is_free(map, 2.25, 1.4));
  EXPECT_FALSE(is_free(map, 4.4, 1.0)) << "window";
  EXPECT_FALSE(is_free(map, 0.1, 1.0)) << "entrance";
  EXPECT_EQ(map.free_count(), 2U * 40U * 40U + 2U * 16U);
}

TEST(House, ALidarSeesTheLegsOfATableAndAllOfABed) {
  House house = two_rooms();
  house.furniture = {table("table", {1.2, 1.2, 0.0}, 0.8, 1.2),
                     bed("bed", {3.3, 1.2, 0.0}, 1.9, 0.9)};
  const CoarseMap map = occupancy(house, 0.05);
  EXPECT_TRUE(is_free(map, 1.2, 1.2));
  EXPECT_FALSE(is_free(map, 0.82, 0.62));
  EXPECT_FALSE(is_free(map, 3.3, 1.2));
  const CoarseMap above = occupancy(house, 0.05, {0.72, 0.72});
  EXPECT_FALSE(is_free(above, 1.2, 1.2));
  EXPECT_TRUE(is_free(above, 3.3, 1.2));
}

TEST(House, APieceThinnerThanACellStillShows) {
  House house = two_rooms();
  house.furniture = {block("pole", {1.0, 1.0, 0.3}, 0.01, 0.01, 2.0)};
  const CoarseMap map = occupancy(house, 0.1);
  EXPECT_FALSE(is_free(map, 1.0, 1.0));
  EXPECT_EQ(walls(house, 0.1).free_count() - map.free_count(), 1U);
}

TEST(House, PiecesTurnAndRoundOnesAreRound) {
  House house = two_rooms();
  house.furniture = {block("board", {1.2, 1.2, kPi / 4.0}, 1.2, 0.1, 1.0),
                     block("plant", {3.3, 1.2, 0.0}, 1.0, 1.0, 1.0, 0.0, true)};
  const CoarseMap map = occupancy(house, 0.05);
  EXPECT_FALSE(is_free(map, 1.5, 1.5));
  EXPECT_TRUE(is_free(map, 1.5, 0.9));
  EXPECT_FALSE(is_free(map, 3.3, 1.6));
  EXPECT_TRUE(is_free(map, 3.7, 1.6)) << "the corner of its square";
  const Rectangle board = house.furniture[0].footprint();
  EXPECT_NEAR(board.width(), (1.2 + 0.1) * std::sqrt(0.5), 1e-12);
}

TEST(House, RefusesCellsOfNoSize) {
  EXPECT_THROW(walls(two_rooms(), 0.0), std::invalid_argument);
  EXPECT_THROW(occupancy(two_rooms(), std::numeric_limits<double>::infinity()),
               std::invalid_argument);
}

TEST(House, WallBlocksLeaveLintelsAndSills) {
  const House house = two_rooms();
  double above = 0.0;
  double below = 0.0;
  for (const Wall& wall : wall_blocks(house)) {
    above += wall.bottom_m > 0.0 ? wall.area.area() : 0.0;
    below += wall.top_m == 0.9 ? wall.area.area() : 0.0;
  }
  EXPECT_NEAR(above, 0.08 + 0.2 + 0.18, 1e-9);
  EXPECT_NEAR(below, 0.2, 1e-9);
}

TEST(Openings, TheWallBetweenTwoRoomsIsWhereTheyFaceEachOther) {
  const Rectangle a{0.0, 0.0, 2.0, 2.0};
  const auto beside = wall_between(a, {2.1, 1.0, 4.0, 3.0});
  ASSERT_TRUE(beside);
  EXPECT_EQ(beside->x0, 2.0);
  EXPECT_EQ(beside->x1, 2.1);
  EXPECT_EQ(beside->y0, 1.0);
  EXPECT_EQ(beside->y1, 2.0);
  EXPECT_TRUE(wall_between(a, {0.5, 2.2, 1.0, 4.0}));
  EXPECT_FALSE(wall_between(a, {2.1, 2.1, 4.0, 3.0})) << "only a corner";
  EXPECT_FALSE(wall_between(a, {3.0, 0.0, 4.0, 2.0})) << "another room's width away";
}

TEST(Openings, ADoorNeedsItsWidthOfWall) {
  House house = two_rooms();
  std::mt19937_64 rng{1};
  EXPECT_TRUE(add_door(house, rng, 0, 1, 0.8));
  EXPECT_NEAR(house.openings.back().width_m(), 0.8, 1e-9);
  EXPECT_FALSE(add_door(house, rng, 0, 1, 1.9));
  EXPECT_FALSE(add_passage(house, rng, 0, 1, 2.5, 3.0));
}

TEST(Openings, OuterWallsAreThoseWithNoRoomBeyond) {
  const House house = two_rooms();
  const std::vector<OuterWall> outer = outer_walls(house, 0, 0.2);
  ASSERT_EQ(outer.size(), 3U);
  for (const OuterWall& wall : outer) {
    EXPECT_NE(wall.side, 0);
  }
}

}  // namespace
}  // namespace cmn
