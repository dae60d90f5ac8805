// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/example_renderer.hpp"

#include "coarse_map_nav/evaluation/house_generator.hpp"
#include "coarse_map_nav/scene/house_scene.hpp"

#include "file_fixture.hpp"
#include "learning_examples.hpp"
#include <gmock/gmock.h>

namespace cmn {
namespace {

ExampleRenderer renderer_of(std::uint32_t house, const ExampleParams& params = {}) {
  return {house_scene(generate_house(house), house), params, house};
}

/// The test is pointless in a build without the 3D simulator.
bool is_absent() {
  return error_of([] {
           make_ray_caster(std::make_shared<const MeshScene>());
         }).find("apt install") != std::string::npos;
}

TEST(ExampleRenderer, GivesTheSameForTheSameSeed) {
  if (is_absent()) {
    GTEST_SKIP() << "the 3D simulator is left out of this build";
  }
  ExampleRenderer first = renderer_of(3);
  ExampleRenderer second = renderer_of(3);
  for (int i = 0; i < 3; ++i) {
    const Example a = first.next();
    const Example b = second.next();
    EXPECT_EQ(cv::norm(a.near, b.near, cv::NORM_INF), 0.0);
    EXPECT_EQ(cv::norm(a.panorama.views[3], b.panorama.views[3], cv::NORM_INF), 0.0);
    EXPECT_EQ(a.camera_height_m, b.camera_height_m);
  }
}

TEST(ExampleRenderer, TheRobotStandsOnFreeGroundAndSeesSomething) {
  if (is_absent()) {
    GTEST_SKIP() << "the 3D simulator is left out of this build";
  }
  ExampleRenderer renderer = renderer_of(4);
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const Example example = renderer.next();
    for (const int cell : {kNearSize / 2 - 10, kNearSize / 2, kNearSize / 2 + 9}) {
      EXPECT_EQ(example.near.at<std::uint8_t>(kNearSize / 2, cell) & kTruthOccupied, 0);
    }
    EXPECT_EQ(example.wide.at<std::uint8_t>(kWideSize / 2, kWideSize / 2) & kTruthOccupied, 0);
    EXPECT_GE(example.camera_height_m, 0.25F);
    EXPECT_LE(example.camera_height_m, 0.6F);
    for (const cv::Mat& view : example.panorama.views) {
      EXPECT_GT(cv::mean(view)[0], 1.0);
    }
  }
}

TEST(ExampleRenderer, AFreeCellOfTheWideSquareIsFreeInTheNearOne) {
  if (is_absent()) {
    GTEST_SKIP() << "the 3D simulator is left out of this build";
  }
  ExampleRenderer renderer = renderer_of(5);
  int differing = 0;
  int compared = 0;
  for (int i = 0; i < 10; ++i) {
    const Example example = renderer.next();
    for (int iy = 0; iy < kNearSize; ++iy) {
      for (int ix = 0; ix < kNearSize; ++ix) {
        // 1 cm cells from the middle -> 5 cm cells from the middle.
        const auto wide = [](int near) {
          return kWideSize / 2 + static_cast<int>(std::floor((near - kNearSize / 2 + 0.5) / 5.0));
        };
        const bool is_free =
            (example.wide.at<std::uint8_t>(wide(iy), wide(ix)) & kTruthOccupied) == 0;
        ++compared;
        differing += is_free && (example.near.at<std::uint8_t>(iy, ix) & kTruthOccupied) != 0;
      }
    }
  }
  // Both are sampled at the nearest cell of a turned map: corners of cells may be missed.
  EXPECT_LT(differing, compared / 200);
}

TEST(ExampleRenderer, SaysWhenTheRobotFitsNowhere) {
  if (is_absent()) {
    GTEST_SKIP() << "the 3D simulator is left out of this build";
  }
  ExampleParams params;
  params.clearance_m = 1.0;
  House hut;
  hut.outline = {0.0, 0.0, 1.4, 1.4};
  hut.rooms = {{RoomPurpose::kHall, {0.2, 0.2, 1.2, 1.2}}};
  hut.walls = {{{0.0, 0.0, 1.4, 0.2}, 0.0, 2.5},
               {{0.0, 1.2, 1.4, 1.4}, 0.0, 2.5},
               {{0.0, 0.2, 0.2, 1.2}, 0.0, 2.5},
               {{1.2, 0.2, 1.4, 1.2}, 0.0, 2.5}};
  EXPECT_THAT(error_of([&] {
                ExampleRenderer{house_scene(hut, 1), params, 1};
              }),
              ::testing::HasSubstr("fits nowhere"));
}

TEST(Repaint, ChangesAboutTheShareOfMaterialsThatIsAskedFor) {
  MeshScene scene;
  for (int i = 0; i < 200; ++i) {
    scene.add_material({});
  }
  std::mt19937_64 rng{1};
  repaint(scene, 0.5, rng);
  int changed = 0;
  for (const Material& material : scene.materials) {
    changed += !material.texture.empty() || material.colour != Material{}.colour;
  }
  EXPECT_NEAR(changed, 100, 30);  // 4 standard deviations
}

}  // namespace
}  // namespace cmn
