// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/grid_planner.hpp"

#include <cmath>

#include "ascii_map.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(GridPlanner, DiagonalsDoNotCutCorners) {
  const CoarseMap map = ascii_map({
      "#.",
      "..",
  });
  const GridPath around = shortest_path(map, {0, 0}, {1, 1}, Connectivity::kEight);
  EXPECT_THAT(around.cells, testing::ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{1, 1}));
  EXPECT_DOUBLE_EQ(around.cost, 2.0);
}

TEST(GridPlanner, DiagonalsDoNotSqueezeThroughAWall) {
  const CoarseMap map = ascii_map({
      "#.",
      ".#",
  });
  const GridPath none = shortest_path(map, {0, 0}, {1, 1}, Connectivity::kEight);
  EXPECT_TRUE(none.cells.empty());
  EXPECT_TRUE(std::isinf(none.cost));
}

TEST(GridPlanner, DiagonalsShortenTheWayInTheOpen) {
  const CoarseMap map = ascii_map({
      "....",
      "....",
      "....",
  });
  EXPECT_DOUBLE_EQ(shortest_path(map, {0, 0}, {3, 2}, Connectivity::kFour).cost, 5.0);
  EXPECT_DOUBLE_EQ(shortest_path(map, {0, 0}, {3, 2}, Connectivity::kEight).cost,
                   1.0 + 2.0 * std::sqrt(2.0));
}

TEST(GridPlanner, GoesStraightOnAsLongAsThatIsShortest) {
  const CoarseMap map = ascii_map({
      "...",
      "...",
  });
  EXPECT_THAT(shortest_path(map, {0, 0}, {2, 1}, Connectivity::kFour, {1, 0}).cells,
              testing::ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{2, 0}, Cell{2, 1}));
  EXPECT_THAT(shortest_path(map, {0, 0}, {2, 1}, Connectivity::kFour, {0, 1}).cells,
              testing::ElementsAre(Cell{0, 0}, Cell{0, 1}, Cell{1, 1}, Cell{2, 1}));
}

TEST(GridPlanner, OccupiedOrOutsideEndsHaveNoWay) {
  const CoarseMap map = ascii_map({"..#"});
  EXPECT_TRUE(shortest_path(map, {0, 0}, {2, 0}, Connectivity::kFour).cells.empty());
  EXPECT_TRUE(shortest_path(map, {2, 0}, {0, 0}, Connectivity::kFour).cells.empty());
  EXPECT_TRUE(shortest_path(map, {0, 0}, {0, 7}, Connectivity::kEight).cells.empty());
}

TEST(GridPlanner, TheWayToWhereOneStandsIsOneCellLong) {
  const CoarseMap map = ascii_map({".."});
  const GridPath path = shortest_path(map, {1, 0}, {1, 0}, Connectivity::kEight);
  EXPECT_THAT(path.cells, testing::ElementsAre(Cell{1, 0}));
  EXPECT_EQ(path.cost, 0.0);
}

}  // namespace
}  // namespace cmn
