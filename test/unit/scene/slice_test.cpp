// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/slice.hpp"

#include "coarse_map_nav/scene/extrusion.hpp"
#include "coarse_map_nav/scene/scene_world.hpp"
#include "coarse_map_nav/scene/sdf_reader.hpp"

#include <array>
#include <cstddef>

#include "ascii_map.hpp"
#include "file_fixture.hpp"
#include "scenes.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace cmn {
namespace {

using ::testing::HasSubstr;

bool is_free(const CoarseMap& map, Point2 p) { return map.is_free(map.cell_of(p)); }

/// A box room whose walls are thin, with floor.
MeshScene furnished() {
  MeshScene scene = box_room();
  add_box(scene, {1, 1, 0.3F}, {1.5F, 2, 0.4F}, 0);  // a shelf in the air
  add_box(scene, {3, 3, 0}, {3.5F, 3.5F, 1}, 0);     // a hollow block
  return scene;
}

TEST(Slice, HoldsWhatStandsWithinTheBand) {
  SliceParams params;
  params.band = {0.02, 0.6};
  const CoarseMap body = slice(furnished(), params);
  EXPECT_TRUE(is_free(body, {0.5, 0.5}));
  EXPECT_FALSE(is_free(body, {1.25, 1.5}));
  EXPECT_FALSE(is_free(body, {3.25, 3.25})) << "the inside of a hollow block";
  EXPECT_FALSE(is_free(body, {-0.5, 2.0})) << "the outside";
  params.band = {0.2, 0.2};
  EXPECT_TRUE(is_free(slice(furnished(), params), {1.25, 1.5})) << "below the shelf";
  EXPECT_NEAR(static_cast<double>(body.free_count()) * 0.0025, 20.0 - 0.5 - 0.25, 0.5);
}

TEST(Slice, WallsOnTheBordersOfCellsBelongToTheCellsBehindThem) {
  MeshScene scene;
  const std::uint32_t paint = scene.add_material({});
  scene.add_quad({Eigen::Vector3f{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, paint);
  add_box(scene, {1, 1, 0}, {2, 3, 1}, paint);
  SliceParams params;
  params.resolution_m = 0.5;
  params.inside = Point2{0.75, 0.75};
  const CoarseMap map = slice(scene, params);
  int occupied = 0;
  for (double x = 0.25; x < 4.0; x += 0.5) {
    for (double y = 0.25; y < 4.0; y += 0.5) {
      occupied += !is_free(map, {x, y});
    }
  }
  EXPECT_EQ(occupied, 2 * 4);
}

TEST(Slice, OfAnExtrudedMapIsTheMap) {
  const CoarseMap map =
      ascii_map({"##########", "#   #    #", "#   #  # #", "#      # #", "##########"}, 0.5);
  SliceParams params;
  params.resolution_m = 0.5;
  const CoarseMap back = slice(extrude(map), params);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      EXPECT_EQ(map.is_free({x, y}), is_free(back, map.center_of({x, y}))) << x << ", " << y;
    }
  }
}

TEST(Slice, OneThatIsAskedForIsTaken) {
  MeshScene two = box_room();
  add(two, box_room(),
      Eigen::Affine3d{Eigen::Translation3d{10, 0, 0} * Eigen::Scaling(1.5, 1.5, 1.0)});
  SliceParams params;
  EXPECT_TRUE(is_free(slice(two, params), {12, 2}));
  params.inside = Point2{1, 1};
  EXPECT_TRUE(is_free(slice(two, params), {1, 2}));
  EXPECT_FALSE(is_free(slice(two, params), {12, 2}));
  params.inside = Point2{-20, 0};
  EXPECT_THAT(error_of([&] { slice(two, params); }), HasSubstr("no free floor"));
}

TEST(Slice, WithoutFloorThereIsNothingToDriveOn) {
  MeshScene scene;
  EXPECT_THAT(error_of([&] { slice(scene, {}); }), HasSubstr("no floor"));
  add_box(scene, {0, 0, 3}, {1, 1, 4}, scene.add_material({}));
  EXPECT_THAT(error_of([&] { slice(scene, {}); }), HasSubstr("no floor"));
}

TEST(Slice, AnAreaTooLargeIsAnError) {
  MeshScene scene;
  add_box(scene, {0, 0, 0}, {1e5F, 1e5F, 1}, scene.add_material({}));
  EXPECT_THAT(error_of([&] { slice(scene, {}); }), HasSubstr("too large"));
}

TEST(Slice, OfTheSmallHouseAgreesWithItsShippedMap) {
  const std::string world = data_file("small_house/worlds/small_house.world");
  CMN_NEEDS_DATA(world);
  const std::string picture = data_file("small_house/maps/turtlebot3_waffle_pi/map.pgm");
  std::vector<std::string> warnings;
  SliceParams params;
  params.band = {0.13, 0.13};  // of the LiDAR that the map was made with
  const CoarseMap ours = slice(read_sdf(world, warnings), params);
  // The map's yaml: origin -12.5, -12.5; 0.05 m; occupied above 0.65, free below 0.196.
  const cv::Mat theirs = cv::imread(picture, cv::IMREAD_GRAYSCALE);
  // Of what the map shows as occupied, and as free.
  std::array<int, 2> known{};
  std::array<int, 2> agree{};
  for (int row = 0; row < theirs.rows; ++row) {
    for (int column = 0; column < theirs.cols; ++column) {
      const double p = (255 - theirs.at<std::uint8_t>(row, column)) / 255.0;
      if (p >= 0.196 && p <= 0.65) {
        continue;
      }
      const Cell at =
          ours.cell_of({-12.5 + 0.05 * (column + 0.5), -12.5 + 0.05 * (theirs.rows - row - 0.5)});
      const bool is_free = p < 0.196;
      bool is_near = false;
      for (int i = 0; i < 9; ++i) {
        is_near |= ours.is_free({at.x + i % 3 - 1, at.y + i / 3 - 1}) == is_free;
      }
      const std::size_t kind = is_free ? 1 : 0;
      ++known[kind];
      agree[kind] += is_near ? 1 : 0;
    }
  }
  const auto share = [](int part, int all) { return static_cast<double>(part) / all; };
  // Measured: 0.985, 0.929, 0.988. What differs are outer walls that the map shows as free, and
  // thin things.
  EXPECT_GT(share(agree[0] + agree[1], known[0] + known[1]), 0.98);
  EXPECT_GT(share(agree[0], known[0]), 0.92);
  EXPECT_GT(share(agree[1], known[1]), 0.98);
}

}  // namespace
}  // namespace cmn
