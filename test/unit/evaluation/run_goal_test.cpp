// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/run_goal.hpp"

#include <string>

#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A drawing half as large as the world.
MapPlaces three_places() {
  MapPlaces places;
  places.places = {{"sofa", {2.0, 4.0}, {1.0, 2.0}},
                   {"door", {8.0, 4.0}, {4.0, 2.0}},
                   {"bed", {2.0, 10.0}, {1.0, 5.0}}};
  places.default_goal = "bed";
  return places;
}

TEST(RunGoal, IsAPlaceByName) {
  const RunGoal goal = goal_of("door", three_places(), true);
  EXPECT_EQ(goal.name, "door");
  EXPECT_EQ(goal.map.x, 4.0);
  ASSERT_TRUE(goal.world.has_value());
  EXPECT_EQ(goal.world->x, 8.0);
}

TEST(RunGoal, IsTheDefaultWhenNoneIsNamed) {
  EXPECT_EQ(goal_of("", three_places(), true).name, "bed");
}

TEST(RunGoal, IsAPointWhosePlaceInTheWorldComesFromThePlaces) {
  for (const char* text : {"2.5 3", "2.5,3", " 2.5 , 3 "}) {
    const RunGoal goal = goal_of(text, three_places(), true);
    EXPECT_EQ(goal.map.x, 2.5);
    EXPECT_EQ(goal.map.y, 3.0);
    ASSERT_TRUE(goal.world.has_value());
    EXPECT_NEAR(goal.world->x, 5.0, 1e-9);
    EXPECT_NEAR(goal.world->y, 6.0, 1e-9);
  }
  EXPECT_FALSE(goal_of("2.5 3", {}, true).world.has_value());
}

TEST(RunGoal, IsUnknownInAnotherWorld) {
  EXPECT_FALSE(goal_of("door", three_places(), false).world.has_value());
  EXPECT_FALSE(goal_of("1 1", three_places(), false).world.has_value());
}

TEST(RunGoal, IsRefusedWithTheListOfPlaces) {
  for (const std::string text : {"attic", "1", "1 2 3", "1 nan", "1 2 x"}) {
    EXPECT_THAT(error_of([&] { goal_of(text, three_places(), true); }),
                AllOf(HasSubstr(text), HasSubstr("sofa, door, bed")));
  }
  EXPECT_THAT(error_of([] { goal_of("", {}, true); }), HasSubstr("no goal is given"));
}

TEST(RunGoal, KnowsWhetherThePlacesLieInThisWorld) {
  const std::string world = file_with("w.yaml", "");
  const std::string name = world.substr(world.rfind('/') + 1);
  const std::string map = file_with("map.yaml", "world: " + name + "\n");
  EXPECT_TRUE(read_places_in(map, world).second);
  EXPECT_FALSE(read_places_in(map, map).second);
  EXPECT_FALSE(read_places_in(map, "").second);
  EXPECT_TRUE(read_places_in("drawing.png", world).first.places.empty());
}

}  // namespace
}  // namespace cmn
