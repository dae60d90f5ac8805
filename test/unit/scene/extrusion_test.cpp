// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/extrusion.hpp"

#include "coarse_map_nav/scene/slice.hpp"

#include <algorithm>
#include <random>

#include "ascii_map.hpp"
#include "scenes.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

const std::vector<std::string> kRooms{"########", "#...#..#", "#......#", "#...#..#", "########"};

TEST(Extrusion, WallsAreAsHighAsToldAndStandAroundTheFreeCells) {
  ExtrusionParams params;
  params.height_m = 3.0;
  const MeshScene scene = extrude(ascii_map(kRooms, 0.5), params);
  EXPECT_TRUE(scene.bounds().min().isApprox(Eigen::Vector3f{0.5F, 0.5F, 0.0F}));
  EXPECT_TRUE(scene.bounds().max().isApprox(Eigen::Vector3f{3.5F, 2.0F, 3.0F}));
  EXPECT_FALSE(scene.lights.empty());
}

TEST(Extrusion, WithoutACeilingTheSkyIsOpen) {
  ExtrusionParams params;
  std::vector<Hit> hits;
  const SceneRay up{{0.75F, 0.75F, 1.0F}, {0.0F, 0.0F, 1.0F}};
  caster_of(extrude(ascii_map(kRooms, 0.5), params))->cast({up}, hits);
  EXPECT_NEAR(hits[0].way, params.height_m - 1.0, 1e-4);
  params.has_ceiling = false;
  caster_of(extrude(ascii_map(kRooms, 0.5), params))->cast({up}, hits);
  EXPECT_FALSE(hits[0].is_hit());
}

TEST(Extrusion, ItsSliceIsTheMapWhereverItLies) {
  const CoarseMap map = ascii_map(kRooms, 0.5, {4.0, -2.0, 0.0});
  SliceParams params;
  params.resolution_m = 0.5;
  params.band = {1.0, 1.0};
  const CoarseMap cut = slice(extrude(map), params);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      EXPECT_EQ(cut.is_free(cut.cell_of(map.center_of({x, y}))), map.is_free({x, y}))
          << x << ", " << y;
    }
  }
}

TEST(Rectangles, CoverEachCellOnceAndNoOther) {
  std::mt19937 rng{3};
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    Grid<std::uint8_t> grid{13, 9};
    for (std::uint8_t& cell : grid.values()) {
      cell = rng() % 3 == 0 ? 1 : 0;
    }
    Grid<int> covered{13, 9};
    for (const Rectangle& r : rectangles_of(grid, 0)) {
      for (int y = static_cast<int>(r.y0); y < static_cast<int>(r.y1); ++y) {
        for (int x = static_cast<int>(r.x0); x < static_cast<int>(r.x1); ++x) {
          ++covered({x, y});
        }
      }
    }
    for (std::size_t i = 0; i < grid.size(); ++i) {
      ASSERT_EQ(covered[i], grid[i] == 0 ? 1 : 0);
    }
  }
}

TEST(Lamps, HangUnderTheCeilingAndGrowInNumberWithTheArea) {
  MeshScene scene;
  add_lamps(scene, {Eigen::Vector3f{0, 0, 0}, Eigen::Vector3f{8.2F, 3.9F, 2.5F}});
  ASSERT_EQ(scene.lights.size(), 2U);
  for (const Light& lamp : scene.lights) {
    EXPECT_GT(lamp.position.z(), 2.0F);
    EXPECT_LT(lamp.position.z(), 2.5F);
  }
  EXPECT_LT(scene.lights[0].position.x(), 4.1F);
  EXPECT_GT(scene.lights[1].position.x(), 4.1F);
}

}  // namespace
}  // namespace cmn
