// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/ros/conversions.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "file_fixture.hpp"
#include "ros_graph.hpp"
#include <gtest/gtest.h>
#include <nav_msgs/GetMap.h>
#include <nav_msgs/OccupancyGrid.h>

namespace cmn {
namespace {

const char* const kHomeMap = CMN_SOURCE_DIR "/maps/home.yaml";

/// How often `word` stands in `text`.
int count_of(const std::string& text, const std::string& word) {
  int count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

/// What a program says that has to refuse these arguments.
std::string refusal_of(const std::string& program, const std::vector<std::string>& arguments) {
  NodeProcess node{program, arguments};
  EXPECT_TRUE(wait_for([&] { return !node.is_running(); })) << program << " goes on running";
  EXPECT_EQ(node.exit_status().value_or(-1), 1);
  return node.output();
}

TEST(CoarseMapServer, RefusesEachUnusableMapWithOneErrorThatNamesIt) {
  const std::string wall =
      file_with("wall.pgm", std::string("P5\n4 4\n255\n") + std::string(16, '\0'));
  const std::string noise = file_with("noise.png", "this is no picture");
  const std::string orphan = file_with("orphan.yaml",
                                       "image: nowhere.png\nresolution: 0.4\n"
                                       "origin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
                                       "free_thresh: 0.196\n");
  const std::string scribble = file_with("scribble.yaml", "image: [unclosed\n");
  struct Case {
    std::string map;
    std::string names;
  };
  for (const Case& c :
       {Case{"/nowhere/map.yaml", "/nowhere/map.yaml"}, Case{wall, wall}, Case{noise, noise},
        Case{orphan, "nowhere.png"}, Case{scribble, scribble}, Case{"", "map: name the file"}}) {
    SCOPED_TRACE(c.map);
    const std::string said = refusal_of("coarse_map_server", {"_map:=" + c.map});
    EXPECT_NE(said.find(c.names), std::string::npos) << said;
    EXPECT_EQ(count_of(said, "[ERROR]"), 1) << said;
    EXPECT_EQ(count_of(said, "terminate called"), 0) << said;
  }
}

TEST(EveryNode, ListsAllBadParametersAtOnceAndAdvertisesNothing) {
  const Inbox<nav_msgs::OccupancyGrid> maps{"map"};
  for (const char* program : {"coarse_map_server", "perception", "localizer", "planner",
                              "motion_controller", "simulator"}) {
    SCOPED_TRACE(program);
    const std::string said =
        refusal_of(program, {std::string("_map:=") + kHomeMap, "_motion/max_linear_mps:=-1.0",
                             "_localization/converged_confidence:=2.0", "_planning/polcy:=path",
                             "_frames/base:=3", "__name:=misled_" + std::string(program)});
    for (const char* problem :
         {"motion/max_linear_mps: -1 is outside", "localization/converged_confidence: 2 is outside",
          "planning/polcy: unknown parameter, did you mean planning/policy?",
          "frames/base: expected a word"}) {
      EXPECT_EQ(count_of(said, problem), 1) << problem << "\nin\n" << said;
    }
  }
  EXPECT_TRUE(maps.empty());
  EXPECT_FALSE(maps.is_connected());
}

TEST(CoarseMapServer, MapIsLatchedAndServedAsDrawn) {
  NodeProcess node{"coarse_map_server", {std::string("_map:=") + kHomeMap}};
  const CoarseMap drawn = read_map(kHomeMap);
  Inbox<nav_msgs::OccupancyGrid> early{"map"};
  ASSERT_TRUE(wait_for([&] { return !early.empty(); })) << node.output();
  Inbox<nav_msgs::OccupancyGrid> late{"map"};
  ASSERT_TRUE(wait_for([&] { return !late.empty(); })) << "not latched";

  nav_msgs::GetMap answer;
  ASSERT_TRUE(ros::service::call("static_map", answer));
  for (const auto& grid : {early.back(), late.back(), answer.response.map}) {
    EXPECT_EQ(grid.header.frame_id, "map");
    std::string why;
    const auto map = map_of(grid, why);
    ASSERT_TRUE(map) << why;
    EXPECT_EQ(map->width(), drawn.width());
    EXPECT_EQ(map->height(), drawn.height());
    EXPECT_EQ(map->resolution(), drawn.resolution());
    EXPECT_LE(map->free_count(), drawn.free_count()) << "closed pockets may be left out, no more";
  }
}

TEST(CoarseMapServer, DiesAndComesBackWithTheSameMap) {
  Inbox<nav_msgs::OccupancyGrid> maps{"map"};
  NodeProcess first{"coarse_map_server", {std::string("_map:=") + kHomeMap}};
  ASSERT_TRUE(wait_for([&] { return !maps.empty(); })) << first.output();
  const auto data = maps.back().data;
  first.end(SIGKILL);
  maps.clear();
  NodeProcess second{"coarse_map_server", {std::string("_map:=") + kHomeMap}};
  ASSERT_TRUE(wait_for([&] { return !maps.empty(); })) << second.output();
  EXPECT_EQ(maps.back().data, data);
}

}  // namespace
}  // namespace cmn
