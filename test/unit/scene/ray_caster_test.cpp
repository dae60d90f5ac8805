// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/ray_caster.hpp"

#include "coarse_map_nav/scene/texture.hpp"

#include <cmath>

#include "scenes.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

Hit hit_of(const MeshScene& scene, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
           float reach = 100.0F) {
  std::vector<Hit> hits;
  caster_of(scene)->cast({{origin, direction, reach}}, hits);
  return hits.at(0);
}

TEST(RayCaster, WaysToTheWallsOfABoxAreExact) {
  const MeshScene room = box_room();
  EXPECT_NEAR(hit_of(room, {1, 2, 1}, {1, 0, 0}).way, 3.0, 1e-5);
  EXPECT_NEAR(hit_of(room, {1, 2, 1}, {-1, 0, 0}).way, 1.0, 1e-5);
  EXPECT_NEAR(hit_of(room, {1, 2, 1}, {0, 0, -1}).way, 1.0, 1e-5);
  const Eigen::Vector3f slanted = Eigen::Vector3f{-1, 1, 0}.normalized();
  EXPECT_NEAR(hit_of(room, {1, 2, 1}, slanted).way, std::sqrt(2.0), 1e-5);
}

TEST(RayCaster, WaysAreInUnitsOfTheDirection) {
  EXPECT_NEAR(hit_of(box_room(), {1, 2, 1}, {0.5F, 0, 0}).way, 6.0, 1e-5);
}

TEST(RayCaster, WhatLiesBeyondTheReachIsNotHit) {
  EXPECT_FALSE(hit_of(box_room(), {1, 2, 1}, {1, 0, 0}, 2.9F).is_hit());
  EXPECT_TRUE(hit_of(box_room(), {1, 2, 1}, {1, 0, 0}, 3.1F).is_hit());
  EXPECT_FALSE(hit_of(box_room(), {1, 2, 9}, {0, 0, 1}).is_hit());
}

TEST(RayCaster, NormalsPointBackToTheRay) {
  const MeshScene room = box_room();
  for (const Eigen::Vector3f& direction :
       {Eigen::Vector3f{1, 0, 0}, Eigen::Vector3f{0, -1, 0}, Eigen::Vector3f{0, 0, 1}}) {
    const Hit hit = hit_of(room, {1, 2, 1}, direction);
    EXPECT_TRUE(normal_at(room, hit, direction).isApprox(-direction, 1e-5F));
  }
}

TEST(RayCaster, ABallIsSmooth) {
  MeshScene ball;
  add_sphere(ball, 1.0F, ball.add_material({}));
  const Eigen::Vector3f from{3.0F, 0.3F, 0.2F};
  const Hit hit = hit_of(ball, from, {-1, 0, 0});
  const Eigen::Vector3f at = from - Eigen::Vector3f{hit.way, 0, 0};
  EXPECT_TRUE(normal_at(ball, hit, {-1, 0, 0}).isApprox(at.normalized(), 0.02F));
}

TEST(RayCaster, RaysPassClearPanes) {
  MeshScene room = box_room();
  Material glass;
  glass.opacity = 0.2F;
  add_box(room, {2, 1, 0}, {2.01F, 3, 2}, room.add_material(glass));
  EXPECT_NEAR(hit_of(room, {1, 2, 1}, {1, 0, 0}).way, 3.0, 1e-5);
}

TEST(RayCaster, RaysPassHolesOfTextures) {
  MeshScene scene;
  const cv::Mat texture =
      (cv::Mat_<cv::Vec4b>(1, 2) << cv::Vec4b{0, 0, 0, 0}, cv::Vec4b{1, 2, 3, 255});
  scene.add_quad({Eigen::Vector3f{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}},
                 scene.add_material({"leaf", {1, 1, 1}, texture}));
  EXPECT_FALSE(hit_of(scene, {0.5F, 1, 1}, {0, 0, -1}).is_hit());
  EXPECT_TRUE(hit_of(scene, {1.5F, 1, 1}, {0, 0, -1}).is_hit());
  std::vector<std::uint8_t> is_blocked;
  caster_of(scene)->find_blocked(
      {{{0.5F, 1, 1}, {0, 0, -1}, 2.0F}, {{1.5F, 1, 1}, {0, 0, -1}, 2.0F}}, is_blocked);
  EXPECT_EQ(is_blocked, (std::vector<std::uint8_t>{0, 1}));
}

TEST(RayCaster, ManyRaysAreTheSameAsOne) {
  const MeshScene room = box_room();
  std::vector<SceneRay> rays;
  for (int i = 0; i < 1001; ++i) {  // no multiple of a packet
    const float turn = 0.01F * static_cast<float>(i);
    rays.push_back({{1, 2, 1}, {std::cos(turn), std::sin(turn), 0.1F}});
  }
  std::vector<Hit> hits;
  caster_of(room)->cast(rays, hits);
  ASSERT_EQ(hits.size(), rays.size());
  for (std::size_t i = 0; i < rays.size(); i += 37) {
    const Hit one = hit_of(room, rays[i].origin, rays[i].direction);
    EXPECT_EQ(hits[i].triangle, one.triangle);
    EXPECT_FLOAT_EQ(hits[i].way, one.way);
  }
}

TEST(RayCaster, AnEmptySceneHasNothingToHit) {
  EXPECT_FALSE(hit_of({}, {0, 0, 0}, {1, 0, 0}).is_hit());
}

TEST(Texture, IsLookedUpWhereTheRayHits) {
  MeshScene scene;
  const cv::Mat texture =
      (cv::Mat_<cv::Vec4b>(2, 2) << cv::Vec4b{1, 0, 0, 255}, cv::Vec4b{2, 0, 0, 255},
       cv::Vec4b{3, 0, 0, 255}, cv::Vec4b{4, 0, 0, 255});
  scene.add_quad({Eigen::Vector3f{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}},
                 scene.add_material({"four", {1, 1, 1}, texture}));
  const auto blue = [&](float x, float y) {
    return int{colour_at(scene, hit_of(scene, {x, y, 1}, {0, 0, -1}))[0]};
  };
  EXPECT_EQ(blue(0.5F, 1.5F), 1);  // the picture's upper left
  EXPECT_EQ(blue(1.5F, 1.5F), 2);
  EXPECT_EQ(blue(0.5F, 0.5F), 3);
  EXPECT_EQ(blue(1.5F, 0.5F), 4);
}

TEST(Texture, RepeatsBeyondItsBorders) {
  MeshScene scene;
  const cv::Mat texture =
      (cv::Mat_<cv::Vec4b>(1, 2) << cv::Vec4b{1, 0, 0, 255}, cv::Vec4b{2, 0, 0, 255});
  scene.add_quad({Eigen::Vector3f{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}},
                 scene.add_material({"two", {1, 1, 1}, texture}));
  for (Eigen::Vector2f& p : scene.texture_points) {
    p = 3.0F * p + Eigen::Vector2f{-1.0F, -1.0F};
  }
  const Hit hit = hit_of(scene, {0.1F, 1, 1}, {0, 0, -1});  // at -0.85
  EXPECT_EQ(int{texel_at(scene, hit)[0]}, 1);
}

TEST(Texture, OfMaterialsWithoutOneIsTheirColour) {
  MeshScene scene;
  scene.add_quad({Eigen::Vector3f{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}},
                 scene.add_material({"red", {1.0F, 0.5F, -3.0F}, {}}));
  const cv::Vec3b c = colour_at(scene, hit_of(scene, {1, 1, 1}, {0, 0, -1}));
  EXPECT_EQ(c, (cv::Vec3b{0, 128, 255}));
}

TEST(Texture, AnyPictureBecomesBgra) {
  EXPECT_TRUE(texture_of({}).empty());
  EXPECT_TRUE(texture_of(cv::Mat::zeros(2, 2, CV_32FC3)).empty());
  EXPECT_EQ(texture_of(cv::Mat::zeros(4, 2, CV_8UC1)).type(), CV_8UC4);
  const cv::Mat deep(2, 2, CV_16UC3, cv::Scalar{65535, 0, 257});
  EXPECT_EQ(texture_of(deep).at<cv::Vec4b>(0, 0), (cv::Vec4b{255, 0, 1, 255}));
  EXPECT_EQ(texture_of(cv::Mat::zeros(400, 100, CV_8UC3), 100).size(), cv::Size(25, 100));
}

}  // namespace
}  // namespace cmn
