// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/coarsen.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cmn {
namespace {

Grid<std::uint8_t> grid(const std::vector<std::string>& rows) {
  Grid<std::uint8_t> result{static_cast<int>(rows[0].size()), static_cast<int>(rows.size())};
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Cell c = result.cell_at(i);
    result[i] =
        rows[rows.size() - 1 - static_cast<std::size_t>(c.y)][static_cast<std::size_t>(c.x)] == '#';
  }
  return result;
}

TEST(Coarsen, KeepsAWallOfOnePixelAndTheDoorInIt) {
  const Grid<std::uint8_t> fine = grid({"................",  //
                                        "................",  //
                                        "................",  //
                                        "................",  //
                                        "................",  //
                                        "#####....#######",  //
                                        "................",  //
                                        "................",  //
                                        "................",  //
                                        "................",  //
                                        "................",  //
                                        "................"});
  EXPECT_EQ(coarsen(fine, 4.0), grid({"....",  //
                                      "#..#",  //
                                      "...."}));
}

TEST(Coarsen, KeepsAWallThatRunsBetweenTwoCells) {
  EXPECT_EQ(coarsen(grid({"....#...", "....#...", "....#...", "....#..."}), 2.0),
            grid({"..#.", "..#."}));
}

TEST(Coarsen, KeepsASmallObstacleThatNoCellIsMostlyCoveredBy) {
  const Grid<std::uint8_t> fine = grid({"............",  //
                                        "............",  //
                                        "............",  //
                                        "............",  //
                                        ".....##.....",  //
                                        ".....##.....",  //
                                        "............",  //
                                        "............",  //
                                        "............",  //
                                        "............",  //
                                        "............",  //
                                        "............"});
  EXPECT_EQ(coarsen(fine, 4.0), grid({"...", ".#.", "..."}));
}

TEST(Coarsen, LeavesAGridOfOnePixelACellAlone) {
  const Grid<std::uint8_t> fine = grid({".#.#", "##..", ".#.."});
  EXPECT_EQ(coarsen(fine, 1.0), fine);
}

TEST(Coarsen, CoversTheSameGroundWithTheResolutionToMatch) {
  const CoarseMap coarse =
      coarsen(CoarseMap{Grid<std::uint8_t>{40, 20}, 0.05, {1.0, 2.0, 0.0}}, 10);
  EXPECT_EQ(coarse.width(), 10);
  EXPECT_EQ(coarse.height(), 5);
  EXPECT_DOUBLE_EQ(coarse.resolution(), 0.2);
  EXPECT_EQ(coarse.T_map_grid().x, 1.0);
}

TEST(Coarsen, RefusesToMakeCellsSmallerThanPixels) {
  EXPECT_THROW(coarsen(Grid<std::uint8_t>{4, 4}, 0.5), std::invalid_argument);
  const CoarseMap map{Grid<std::uint8_t>{4, 4}, 1.0};
  EXPECT_THROW(coarsen(map, 5), std::invalid_argument);
  EXPECT_THROW(coarsen(map, 0), std::invalid_argument);
}

}  // namespace
}  // namespace cmn
