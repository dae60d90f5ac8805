// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/places.hpp"

#include <filesystem>
#include <string>

#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Places, AreReadInTheOrderOfTheFile) {
  const MapPlaces places =
      read_places(file_with("map.yaml",
                            "image: x.png\nplaces: {sofa: {world: [1, 2], map: [0.5, -3]},\n"
                            "  kitchen: {map: [7, 8], world: [5, 6]}}\ndefault_goal: kitchen\n"));
  ASSERT_EQ(places.places.size(), 2U);
  EXPECT_EQ(places.places[0].name, "sofa");
  EXPECT_EQ(places.places[0].map.y, -3.0);
  EXPECT_EQ(places.default_goal, "kitchen");
  ASSERT_NE(places.find("kitchen"), nullptr);
  EXPECT_EQ(places.find("kitchen")->world.x, 5.0);
  EXPECT_EQ(places.find("attic"), nullptr);
}

TEST(Places, NameTheirWorldRelativeToTheMap) {
  const std::string path = file_with("map.yaml", "world: ../worlds/home.yaml\n");
  const std::filesystem::path folder = std::filesystem::path{path}.parent_path();
  EXPECT_EQ(read_places(path).world, (folder.parent_path() / "worlds/home.yaml").string());
}

TEST(Places, AreEmptyWhenAbsent) {
  const std::string path = file_with("map.yaml", "image: x.png\n");
  EXPECT_TRUE(read_places(path).places.empty());
  EXPECT_TRUE(read_places(path).default_goal.empty());
  EXPECT_TRUE(read_places(path).world.empty());
  EXPECT_TRUE(read_starts(path).empty());
  EXPECT_TRUE(read_starts(file_with("empty.yaml", "")).empty());
}

TEST(Places, AreRejectedByFileAndKeyWhenMalformed) {
  const auto problem = [](const std::string& content) {
    const std::string path = file_with("bad.yaml", content);
    const std::string error = error_of([&] { read_places(path); });
    EXPECT_THAT(error, HasSubstr(path));
    return error;
  };
  EXPECT_THAT(problem("places: [1, 2]"), HasSubstr("places must be"));
  EXPECT_THAT(problem("places: {sofa: 3}"), HasSubstr("places/sofa"));
  EXPECT_THAT(problem("places: {sofa: {world: [1, 2]}}"), HasSubstr("places/sofa/map"));
  EXPECT_THAT(problem("places: {sofa: {world: [1], map: [1, 2]}}"), HasSubstr("places/sofa/world"));
  EXPECT_THAT(problem("places: {sofa: {world: [1, .inf], map: [1, 2]}}"),
              HasSubstr("places/sofa/world"));
  EXPECT_THAT(problem("places: {a: {world: [1, 2], map: [1, 2]}, a: {world: [1, 2], map: [1, 2]}}"),
              HasSubstr("places/a is there twice"));
  EXPECT_THAT(problem("default_goal: attic"), AllOf(HasSubstr("default_goal"), HasSubstr("attic")));
  EXPECT_THAT(problem("default_goal: [1]"), HasSubstr("default_goal"));
  EXPECT_THAT(problem("world: [1]"), HasSubstr("world must be"));
  EXPECT_THAT(problem("- 1"), HasSubstr("top level"));
  EXPECT_THAT(problem("a: {"), HasSubstr("not YAML"));
  EXPECT_THAT(error_of([] { read_places("/nowhere/m.yaml"); }), HasSubstr("/nowhere/m.yaml"));
}

TEST(Starts, AreRead) {
  const auto starts = read_starts(file_with("world.yaml", "starts: [[1, 2], [3.5, -4]]\n"));
  ASSERT_EQ(starts.size(), 2U);
  EXPECT_EQ(starts[1].x, 3.5);
  EXPECT_EQ(starts[1].y, -4.0);
}

TEST(Starts, AreRejectedByFileAndKeyWhenMalformed) {
  EXPECT_THAT(error_of([] { read_starts(file_with("w.yaml", "starts: {a: 1}")); }),
              HasSubstr("starts must be"));
  EXPECT_THAT(error_of([] { read_starts(file_with("w.yaml", "starts: [[1, 2], [3]]")); }),
              AllOf(HasSubstr("w.yaml"), HasSubstr("starts/1")));
}

}  // namespace
}  // namespace cmn
