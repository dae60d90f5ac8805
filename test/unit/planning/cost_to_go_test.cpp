// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/cost_to_go.hpp"

#include <cmath>

#include "ascii_map.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(CostToGo, CountsCellsAroundWalls) {
  const CoarseMap map = ascii_map({
      ".....",
      ".###.",
      ".....",
  });
  const CostToGo cost{map, {2, 2}};
  EXPECT_EQ(cost({2, 2}), 0.0);
  EXPECT_EQ(cost({0, 2}), 2.0);
  EXPECT_EQ(cost({2, 0}), 6.0);
  EXPECT_EQ(cost({4, 0}), 4.0);
}

TEST(CostToGo, IsInfiniteWhereThereIsNoWay) {
  const CoarseMap map = ascii_map({
      "..#.",
      "..#.",
  });
  const CostToGo cost{map, {0, 0}};
  EXPECT_TRUE(std::isinf(cost({2, 0})));
  EXPECT_TRUE(std::isinf(cost({3, 0})));
  EXPECT_TRUE(std::isinf(cost({-1, 0})));
  EXPECT_TRUE(std::isinf(cost({0, 2})));
  EXPECT_FALSE(cost.is_reachable({3, 1}));
  EXPECT_TRUE(cost.path({3, 1}).empty());
  EXPECT_FALSE(cost.next_heading({3, 1}, Heading::kEast));
}

TEST(CostToGo, WithoutAGoalReachesNothing) {
  const CostToGo cost;
  EXPECT_FALSE(cost.is_reachable({0, 0}));
  EXPECT_TRUE(cost.path({0, 0}).empty());
}

TEST(CostToGo, PathGoesStraightOnWhileItCan) {
  const CoarseMap map = ascii_map({
      "...",
      "...",
      "...",
  });
  const CostToGo cost{map, {2, 2}};
  EXPECT_THAT(cost.path({0, 0}, Heading::kEast),
              testing::ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{2, 0}, Cell{2, 1}, Cell{2, 2}));
  EXPECT_THAT(cost.path({0, 0}, Heading::kNorth),
              testing::ElementsAre(Cell{0, 0}, Cell{0, 1}, Cell{0, 2}, Cell{1, 2}, Cell{2, 2}));
  EXPECT_THAT(cost.path({2, 2}), testing::ElementsAre(Cell{2, 2}));
}

TEST(CostToGo, NextHeadingTurnsLeastAndLeftFirst) {
  const CoarseMap map = ascii_map({
      "...",
      "...",
      "...",
  });
  const CostToGo cost{map, {2, 2}};  // from (1, 1) both east and north are downhill
  EXPECT_EQ(cost.next_heading({1, 1}, Heading::kEast), Heading::kEast);
  EXPECT_EQ(cost.next_heading({1, 1}, Heading::kNorth), Heading::kNorth);
  EXPECT_EQ(cost.next_heading({1, 1}, Heading::kWest), Heading::kNorth);
  EXPECT_EQ(cost.next_heading({1, 1}, Heading::kSouth), Heading::kEast);
  EXPECT_FALSE(cost.next_heading({2, 2}, Heading::kEast));
}

TEST(CostToGo, BetweenCellsItIsBilinear) {
  const CostToGo cost{ascii_map({"....", "...."}), {0, 0}};
  EXPECT_DOUBLE_EQ(cost.between_cells({2.5, 0.5}), 2.0);  // the middle of a cell
  EXPECT_DOUBLE_EQ(cost.between_cells({2.0, 0.5}), 1.5);  // half way to its neighbour
  EXPECT_DOUBLE_EQ(cost.between_cells({1.75, 0.75}), 1.25 + 0.25);
  EXPECT_DOUBLE_EQ(cost.between_cells({3.9, 0.5}), 3.0);  // what lies outside does not count
}

TEST(CostToGo, BetweenCellsWallsDoNotCount) {
  const CostToGo cost{ascii_map({"#...", ".#..", "...."}), {0, 0}};
  // Cells (0, 1) and (1, 0) beside (1, 1), which is occupied, and (0, 0).
  EXPECT_DOUBLE_EQ(cost.between_cells({0.75, 0.75}),
                   (0.5625 * 0.0 + 0.1875 * 1.0 + 0.1875 * 1.0) / (1.0 - 0.0625));
  EXPECT_TRUE(std::isinf(cost.between_cells({1.5, 1.5})));
  EXPECT_TRUE(std::isinf(cost.between_cells({0.5, 2.5})));
  EXPECT_TRUE(std::isinf(cost.between_cells({-0.1, 0.5})));
  EXPECT_TRUE(std::isinf(cost.between_cells({4.1, 0.5})));
}

}  // namespace
}  // namespace cmn
