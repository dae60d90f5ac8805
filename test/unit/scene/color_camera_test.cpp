// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/color_camera.hpp"

#include "scenes.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

ColorCameraParams plain() {
  ColorCameraParams params;
  params.noise = 0.0;
  params.auto_exposure = false;
  return params;
}

/// A wall ahead, 2 m wide and high at x = 1, lit evenly: a view of 90 degrees just takes it in.
MeshScene lit_wall(const cv::Mat& texture) {
  MeshScene scene;
  scene.add_quad({Eigen::Vector3f{1, 1, -1}, {1, -1, -1}, {1, -1, 1}, {1, 1, 1}},
                 scene.add_material({"wall", {0.5F, 0.5F, 0.5F}, texture}));
  scene.ambient.setConstant(1.25F);  // 1 on what stands upright
  return scene;
}

cv::Vec3b pixel(const MeshScene& scene, int row, int column,
                const ColorCameraParams& params = plain()) {
  return ColorCamera{params, 1}
      .take(*caster_of(scene), looking_ahead(0, 0, 0))
      .at<cv::Vec3b>(row, column);
}

TEST(ColorCamera, EvenLightGivesBackTheTextureItself) {
  const cv::Mat texture =
      (cv::Mat_<cv::Vec4b>(2, 2) << cv::Vec4b{200, 10, 20, 255}, cv::Vec4b{10, 200, 20, 255},
       cv::Vec4b{10, 20, 200, 255}, cv::Vec4b{90, 90, 90, 255});
  const MeshScene scene = lit_wall(texture);
  const auto near = [](cv::Vec3b a, cv::Vec3b b) { return cv::norm(a, b, cv::NORM_INF) <= 2.0; };
  EXPECT_TRUE(near(pixel(scene, 10, 10), {200, 10, 20}));
  EXPECT_TRUE(near(pixel(scene, 10, 70), {10, 200, 20}));
  EXPECT_TRUE(near(pixel(scene, 70, 10), {10, 20, 200}));
  EXPECT_TRUE(near(pixel(scene, 70, 70), {90, 90, 90}));
}

TEST(ColorCamera, LampsFadeWithDistanceAndObliqueness) {
  MeshScene scene = lit_wall({});
  scene.ambient.setZero();
  Light lamp;
  lamp.position = {0.5F, 0.0F, 0.0F};
  scene.lights = {lamp};
  EXPECT_GT(pixel(scene, 40, 40)[0], pixel(scene, 40, 70)[0]);
  EXPECT_GT(pixel(scene, 40, 70)[0], pixel(scene, 70, 70)[0]);
  scene.lights[0].position = {-4.0F, 0.0F, 0.0F};
  EXPECT_LT(pixel(scene, 40, 40)[0], 120);
}

TEST(ColorCamera, ThingsThrowShadowsUnlessTheyAreOff) {
  MeshScene scene = lit_wall({});
  scene.ambient.setConstant(0.1F);
  Light lamp;
  lamp.position = {0.2F, 0.8F, 0.0F};
  scene.lights = {lamp};
  const cv::Vec3b open = pixel(scene, 40, 70);
  add_box(scene, {0.5F, 0.2F, -0.5F}, {0.52F, 0.6F, 0.5F}, 0);  // left of the view to the right
  EXPECT_LT(pixel(scene, 40, 70)[0], open[0] / 2);
  ColorCameraParams params = plain();
  params.shadow_lights = 0;
  EXPECT_NEAR(pixel(scene, 40, 70, params)[0], open[0], 1);
}

TEST(ColorCamera, TheSunShinesAsItsDirectionSays) {
  MeshScene scene = lit_wall({});
  scene.ambient.setZero();
  Light sun;
  sun.is_sun = true;
  sun.strength.setConstant(1.0F);
  sun.direction = {1.0F, 0.0F, 0.0F};
  scene.lights = {sun};
  EXPECT_NEAR(pixel(scene, 40, 40)[0], 128, 2);
  scene.lights[0].direction = {-1.0F, 0.0F, 0.0F};
  EXPECT_EQ(pixel(scene, 40, 40)[0], 0);
}

TEST(ColorCamera, ASpotLightsItsConeOnly) {
  MeshScene scene = lit_wall({});
  scene.ambient.setZero();
  Light spot;
  spot.position = {0.0F, 0.0F, 0.0F};
  spot.direction = {1.0F, 0.0F, 0.0F};
  spot.cone_cos = 0.95F;
  scene.lights = {spot};
  EXPECT_GT(pixel(scene, 40, 40)[0], 100);
  EXPECT_EQ(pixel(scene, 40, 70)[0], 0);
}

TEST(ColorCamera, AutomaticExposureMakesDarkRoomsBright) {
  MeshScene scene = lit_wall({});
  scene.ambient.setConstant(0.02F);
  ColorCameraParams params = plain();
  const cv::Vec3b dark = pixel(scene, 40, 40, params);
  params.auto_exposure = true;
  EXPECT_GT(pixel(scene, 40, 40, params)[0], 100);
  EXPECT_LT(dark[0], 40);
}

TEST(ColorCamera, TheSameSeedGivesTheSameImages) {
  const MeshScene scene = lit_wall({});
  const auto take = [&](std::uint32_t seed) {
    return ColorCamera{{}, seed}.take(*caster_of(scene), looking_ahead(0, 0, 0));
  };
  EXPECT_EQ(cv::norm(take(1), take(1), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(take(1), take(2), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace cmn
