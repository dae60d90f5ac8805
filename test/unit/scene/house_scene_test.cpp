// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/house_scene.hpp"

#include "coarse_map_nav/evaluation/house_generator.hpp"
#include "coarse_map_nav/scene/scene_world.hpp"
#include "coarse_map_nav/scene/slice.hpp"

#include <filesystem>

#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using ::testing::HasSubstr;

bool is_same(const MeshScene& a, const MeshScene& b) {
  return a.vertices == b.vertices && a.texture_points == b.texture_points &&
         a.triangles.size() == b.triangles.size() && a.materials.size() == b.materials.size();
}

TEST(HouseScene, TheSameSeedGivesTheSameScene) {
  const House house = generate_house(3);
  EXPECT_TRUE(is_same(house_scene(house, 3), house_scene(house, 3)));
}

/// Share of the cells of the house that are free in one map and not within a cell of a free one in
/// the other.
double disagreement(const CoarseMap& a, const CoarseMap& b) {
  int free = 0;
  int alone = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      if (a.is_free({x, y})) {
        const Cell at = b.cell_of(a.center_of({x, y}));
        bool is_near = false;
        for (int i = 0; i < 9; ++i) {
          is_near |= b.is_free({at.x + i % 3 - 1, at.y + i / 3 - 1});
        }
        ++free;
        alone += !is_near;
      }
    }
  }
  return static_cast<double>(alone) / free;
}

TEST(HouseScene, ItsSliceIsTheHousesOwnMap) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const House house = generate_house(seed);
    SliceParams params;
    params.band = {0.2, 0.2};
    const CoarseMap map = occupancy(house, 0.05);
    const CoarseMap cut = slice(house_scene(house, seed), params);
    EXPECT_LT(disagreement(cut, map), 0.001);
    EXPECT_LT(disagreement(map, cut), 0.03);  // what furniture shuts in cannot be driven to
  }
}

TEST(HouseScene, MeshesFillTheirPieces) {
  const auto meshes = open_furniture();
  if (!meshes) {
    GTEST_SKIP() << "sweethome3d-furniture is not installed";
  }
  const House house = generate_house(2);
  int fitted = 0;
  for (const Furniture& piece : house.furniture) {
    std::mt19937_64 rng{1};
    const auto mesh = meshes->fit(piece, rng);
    if (mesh) {
      ++fitted;
      const Eigen::Vector3f size = mesh->bounds().sizes();
      EXPECT_NEAR(size.x(), piece.size_x_m, 1e-3) << piece.name;
      EXPECT_NEAR(size.y(), piece.size_y_m, 1e-3) << piece.name;
      EXPECT_NEAR(size.z(), piece.size_z_m, 1e-3) << piece.name;
      EXPECT_NEAR(mesh->bounds().min().z(), piece.elevation_m, 1e-3) << piece.name;
    }
  }
  EXPECT_GT(fitted, static_cast<int>(house.furniture.size()) / 2);
  EXPECT_TRUE(is_same(house_scene(house, 2, meshes.get()), house_scene(house, 2, meshes.get())));
}

TEST(HouseScene, AFolderWithoutFurnitureGivesNone) {
  EXPECT_EQ(open_furniture("/nowhere"), nullptr);
  const std::string broken = file_with("broken.sh3f", "this is no zip archive");
  const auto meshes = open_furniture(std::filesystem::path{broken}.parent_path().string());
  ASSERT_NE(meshes, nullptr);
  EXPECT_THAT(meshes->warnings(), ::testing::Contains(HasSubstr("broken.sh3f")));
  std::mt19937_64 rng{1};
  EXPECT_FALSE(meshes->fit(generate_house(1).furniture.at(0), rng).has_value());
}

TEST(SceneWorld, IsOpenedByItsName) {
  SceneWorldParams params;
  params.furniture_folder.clear();
  const SceneWorld house = open_scene_world("house:3", params);
  EXPECT_GT(house.body.free_count(), 10000U);
  const SceneWorld map = open_scene_world(CMN_SOURCE_DIR "/worlds/home.yaml", params);
  EXPECT_GT(map.scene->triangles.size(), 100U);
  EXPECT_GT(map.body.free_count(), 1000U);
}

TEST(SceneWorld, HousesHaveNumbers) {
  EXPECT_EQ(house_seed("house:17"), 17U);
  EXPECT_FALSE(house_seed("worlds/house.yaml").has_value());
  for (const char* name : {"house:", "house:x", "house:-1", "house:3 ", "house:99999999999"}) {
    EXPECT_THAT(error_of([&] { house_seed(name); }), HasSubstr("a house has a number"));
  }
}

TEST(SceneWorld, WithoutFurnitureThereAreBoxesAndAWarning) {
  SceneWorldParams params;
  params.furniture_folder = "/nowhere";
  EXPECT_THAT(open_scene_world("house:1", params).warnings,
              ::testing::ElementsAre(HasSubstr("sweethome3d-furniture")));
}

}  // namespace
}  // namespace cmn
