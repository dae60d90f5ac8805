// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/room_layout.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace cmn {
namespace {

/// A room of 3 m x 4 m with a door in the south and one in the north, both in the middle, and a
/// window in the east.
House room_with_two_doors() {
  House house;
  house.outline = {-0.2, -0.2, 3.2, 4.2};
  house.rooms = {{RoomPurpose::kBedroom, {0.0, 0.0, 3.0, 4.0}}};
  house.openings = {{Opening::Kind::kDoor, {1.1, -0.1, 1.9, 0.0}, 0.0, 2.0, 0, -1},
                    {Opening::Kind::kDoor, {1.1, 4.0, 1.9, 4.1}, 0.0, 2.0, 0, -1},
                    {Opening::Kind::kWindow, {3.0, 1.0, 3.2, 3.0}, 0.9, 2.0, 0, -1}};
  return house;
}

TEST(RoomLayout, KeepsDoorsFree) {
  RoomLayout layout{room_with_two_doors(), 0, 0.54};
  EXPECT_FALSE(layout.place({1.2, 0.3, 1.8, 0.7}, {}));
  EXPECT_TRUE(layout.place({0.0, 0.0, 0.6, 0.6}, {}));
  EXPECT_FALSE(layout.place({0.5, 0.5, 0.8, 0.8}, {})) << "taken";
  EXPECT_FALSE(layout.place({-0.1, 2.0, 0.3, 2.5}, {})) << "in the wall";
}

TEST(RoomLayout, RefusesWhatWouldBlockTheWay) {
  RoomLayout layout{room_with_two_doors(), 0, 0.54};
  EXPECT_FALSE(layout.place({0.0, 1.9, 2.6, 2.1}, {})) << "0.4 m are left";
  EXPECT_TRUE(layout.is_vacant({0.0, 1.9, 2.6, 2.1})) << "what is refused takes nothing";
  EXPECT_TRUE(layout.place({0.0, 1.9, 2.2, 2.1}, {})) << "0.8 m are left";
}

TEST(RoomLayout, RefusesWhatCutsOffAPlaceThatMustBeReached) {
  RoomLayout layout{room_with_two_doors(), 0, 0.54};
  ASSERT_TRUE(layout.place({0.0, 1.0, 0.6, 1.8}, {}, {{0.9, 1.4}}));
  EXPECT_FALSE(layout.place({0.75, 1.2, 1.2, 1.7}, {}));
}

TEST(RoomLayout, AWardrobeFindsAWallWithoutADoorOrAWindow) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 rng{seed};
    RoomLayout layout{room_with_two_doors(), 0, 0.54};
    const auto place =
        layout.place_at_wall(rng, against_wall(2.0, 0.6, 0.6, Preference::kCorner, true));
    ASSERT_TRUE(place);
    EXPECT_EQ(place->side, Side::kWest);
    EXPECT_NEAR(place->pose.yaw, 0.0, 1e-12) << "it faces the room";
    EXPECT_NEAR(place->area.x0, 0.0, 1e-12);
    EXPECT_NEAR(place->area.width(), 0.6, 1e-12);
  }
}

TEST(RoomLayout, NothingLeansOnAnOpenSide) {
  House house = room_with_two_doors();
  house.rooms.push_back({RoomPurpose::kLiving, {-4.0, 0.0, 0.0, 4.0}});
  std::mt19937_64 rng{1};
  RoomLayout layout{house, 0, 0.54};
  EXPECT_FALSE(layout.place_at_wall(rng, against_wall(2.0, 0.6, 0.6, Preference::kCorner, true)));
}

TEST(RoomLayout, TheLongestStretchOfAWallLiesBetweenDoors) {
  const RoomLayout layout{room_with_two_doors(), 0, 0.54};
  const auto west = layout.longest_stretch(Side::kWest, 0.6);
  ASSERT_TRUE(west);
  EXPECT_NEAR(west->area.height(), 4.0, 1e-6);
  const auto south = layout.longest_stretch(Side::kSouth, 0.6);
  ASSERT_TRUE(south);
  EXPECT_NEAR(south->area.width(), 1.1, 1e-6);
}

TEST(RoomLayout, TheShareThatCanBeWalkedTo) {
  RoomLayout layout{room_with_two_doors(), 0, 0.54};
  EXPECT_EQ(layout.walkable_share(), 1.0);
  ASSERT_TRUE(layout.place({2.0, 0.0, 2.2, 2.5}, {}));
  ASSERT_TRUE(layout.place({2.23, 2.3, 3.0, 2.5}, {}));
  EXPECT_LT(layout.walkable_share(), 0.95);
}

}  // namespace
}  // namespace cmn
