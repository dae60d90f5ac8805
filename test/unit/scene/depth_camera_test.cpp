// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/depth_camera.hpp"

#include <cmath>

#include "scenes.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

/// Without any fault.
DepthCameraParams faultless() {
  DepthCameraParams params;
  params.noise_m = 0.0;
  params.step_m = 0.0;
  params.baseline_m = 0.0;
  params.grazing_deg = 0.0;
  params.faintest = 0.0;
  params.flying_share = 0.0;
  params.dropout = 0.0;
  params.depth_min_m = 0.0;
  return params;
}

/// A wall at x = `x`, 20 m wide and high about the origin.
void add_wall(MeshScene& scene, float x, float half = 10.0F,
              const Eigen::Vector3f& colour = {1, 1, 1}) {
  scene.add_quad(
      {Eigen::Vector3f{x, -half, -half}, {x, half, -half}, {x, half, half}, {x, -half, half}},
      scene.add_material({"wall", colour, {}}));
}

int holes_in(const cv::Mat& depth) {
  int holes = 0;
  for (int i = 0; i < static_cast<int>(depth.total()); ++i) {
    holes += std::isnan(depth.ptr<float>()[i]);
  }
  return holes;
}

TEST(DepthCamera, TruthIsTheDepthAlongTheAxis) {
  MeshScene scene;
  add_wall(scene, 3.0F);
  const cv::Mat depth =
      DepthCamera{faultless(), 1}.truth(*caster_of(scene), looking_ahead(0.5, 0, 0));
  EXPECT_EQ(depth.size(), cv::Size(320, 240));
  double least = 0.0;
  double most = 0.0;
  cv::minMaxLoc(depth, &least, &most);
  EXPECT_NEAR(least, 2.5, 1e-4);
  EXPECT_NEAR(most, 2.5, 1e-4);
}

TEST(DepthCamera, EveryPixelOfABoxIsWhereTheCameraModelSays) {
  const DepthCameraParams params = faultless();
  const Eigen::Isometry3d T = looking_ahead(1.0, 2.0, 1.0);
  const cv::Mat depth = DepthCamera{params, 1}.truth(*caster_of(box_room()), T);
  const CameraModel camera = params.camera();
  for (int v = 0; v < camera.height; v += 13) {
    for (int u = 0; u < camera.width; u += 17) {
      const double z = depth.at<float>(v, u);
      const Eigen::Vector3d p =
          T * Eigen::Vector3d{(u - camera.cx) / camera.fx * z, (v - camera.cy) / camera.fy * z, z};
      // On one of the faces of the box.
      const double off = std::min({std::abs(p.x() - 4.0), std::abs(p.y()), std::abs(p.y() - 5.0),
                                   std::abs(p.z()), std::abs(p.z() - 2.5)});
      EXPECT_LT(off, 1e-4) << u << ", " << v;
    }
  }
}

TEST(DepthCamera, NothingAheadIsInfinitelyFarAndAHole) {
  DepthCamera camera{faultless(), 1};
  const auto caster = caster_of({});
  EXPECT_TRUE(std::isinf(camera.truth(*caster, looking_ahead(0, 0, 0)).at<float>(3, 3)));
  EXPECT_EQ(holes_in(camera.take(*caster, looking_ahead(0, 0, 0))), 320 * 240);
}

TEST(DepthCamera, WhatIsTooNearOrTooFarIsAHole) {
  MeshScene scene;
  add_wall(scene, 3.0F);
  const auto caster = caster_of(scene);
  DepthCameraParams params = faultless();
  params.depth_max_m = 2.9;
  EXPECT_EQ(holes_in(DepthCamera{params, 1}.take(*caster, looking_ahead(0, 0, 0))), 320 * 240);
  params.depth_max_m = 3.1;
  EXPECT_EQ(holes_in(DepthCamera{params, 1}.take(*caster, looking_ahead(0, 0, 0))), 0);
  params.depth_min_m = 2.0;
  EXPECT_EQ(holes_in(DepthCamera{params, 1}.take(*caster, looking_ahead(2, 0, 0))), 320 * 240);
}

/// Root of the mean square of the error on a wall at `depth_m`.
double error_at(double depth_m, const DepthCameraParams& params) {
  MeshScene scene;
  add_wall(scene, static_cast<float>(depth_m));
  const cv::Mat depth =
      DepthCamera{params, 7}.take(*caster_of(scene), looking_ahead(0, 0, 0)) - depth_m;
  return std::sqrt(depth.dot(depth) / static_cast<double>(depth.total()));
}

TEST(DepthCamera, NoiseGrowsWithTheSquareOfTheDepth) {
  DepthCameraParams params = faultless();
  params.noise_m = 0.002;
  // 76800 pixels of which 9 share their error: 1 % of the spread; the bias of 1/z is less.
  EXPECT_NEAR(error_at(1.0, params), 0.002, 0.0001);
  EXPECT_NEAR(error_at(2.0, params), 0.008, 0.0004);
  EXPECT_NEAR(error_at(4.0, params), 0.032, 0.0020);
}

TEST(DepthCamera, DepthsComeInSteps) {
  DepthCameraParams params = faultless();
  params.step_m = 0.01;
  MeshScene scene;
  add_wall(scene, 3.02F);
  const float z =
      DepthCamera{params, 1}.take(*caster_of(scene), looking_ahead(0, 0, 0)).at<float>(100, 100);
  EXPECT_NEAR(1.0F / z, 0.33, 1e-5);
}

TEST(DepthCamera, LeftOfANearThingIsAHole) {
  MeshScene scene;
  add_wall(scene, 4.0F);
  add_wall(scene, 1.0F, 0.2F);
  DepthCameraParams params = faultless();
  params.baseline_m = 0.05;
  const CameraModel camera = params.camera();
  const cv::Mat depth = DepthCamera{params, 1}.take(*caster_of(scene), looking_ahead(0, 0, 0));
  const int holes = holes_in(depth.row(120));
  // The disparities of the two walls differ by so much.
  EXPECT_NEAR(holes, camera.fx * 0.05 * (1.0 - 0.25), 1.5);
  const int left_edge = static_cast<int>(camera.cx - 0.2 * camera.fx);
  EXPECT_TRUE(std::isnan(depth.at<float>(120, left_edge - 2)));
  EXPECT_FALSE(std::isnan(depth.at<float>(120, static_cast<int>(camera.cx + 0.2 * camera.fx) + 2)));
}

TEST(DepthCamera, DarkFarAndGrazingSurfacesAreHolesMoreOften) {
  DepthCameraParams params = faultless();
  params.faintest = 0.01;
  const auto share = [&](float x, float colour) {
    MeshScene scene;
    add_wall(scene, x, 10.0F, Eigen::Vector3f::Constant(colour));
    return holes_in(DepthCamera{params, 1}.take(*caster_of(scene), looking_ahead(0, 0, 0))) /
           (320.0 * 240.0);
  };
  EXPECT_EQ(share(2.0F, 0.9F), 0.0);
  EXPECT_GT(share(6.0F, 0.3F), share(3.0F, 0.3F));
  EXPECT_GT(share(3.0F, 0.05F), 0.9);
}

TEST(DepthCamera, SomePixelsFlyBetweenNearAndFar) {
  MeshScene scene;
  add_wall(scene, 4.0F);
  add_wall(scene, 1.0F, 0.2F);
  DepthCameraParams params = faultless();
  params.flying_share = 0.5;
  const cv::Mat depth = DepthCamera{params, 1}.take(*caster_of(scene), looking_ahead(0, 0, 0));
  int flying = 0;
  for (int i = 0; i < static_cast<int>(depth.total()); ++i) {
    const float z = depth.ptr<float>()[i];
    EXPECT_GT(z, 0.99F);
    EXPECT_LT(z, 4.01F);
    flying += z > 1.05F && z < 3.9F;
  }
  EXPECT_GT(flying, 20);
}

TEST(DepthCamera, StripesShiftWholeColumns) {
  MeshScene scene;
  add_wall(scene, 3.0F);
  DepthCameraParams params = faultless();
  params.noise_m = 1e-9;
  params.step_m = 0.0;
  params.stripe_share = 0.5;
  const cv::Mat calm = DepthCamera{params, 1}.take(*caster_of(scene), looking_ahead(0, 0, 0));
  params.noise_m = 0.003;
  const cv::Mat striped = DepthCamera{params, 1}.take(*caster_of(scene), looking_ahead(0, 0, 0));
  cv::Mat columns;
  cv::reduce(striped, columns, 0, cv::REDUCE_AVG);
  double least = 0.0;
  double most = 0.0;
  cv::minMaxLoc(columns, &least, &most);
  EXPECT_GT(most - least, 0.1);
  EXPECT_NEAR(calm.at<float>(0, 0), 3.0, 1e-3);
}

TEST(DepthCamera, TheSameSeedGivesTheSameImages) {
  const auto caster = caster_of(box_room());
  const auto take = [&](std::uint32_t seed) {
    DepthCamera camera{{}, seed};
    camera.take(*caster, looking_ahead(1, 2, 1));
    return cv::Mat{camera.take(*caster, looking_ahead(1.1, 2, 1))};
  };
  const cv::Mat first = take(1);
  const auto differ = [&](const cv::Mat& other) {
    int count = 0;
    for (int i = 0; i < static_cast<int>(first.total()); ++i) {
      const float a = first.ptr<float>()[i];
      const float b = other.ptr<float>()[i];
      count += !(a == b || (std::isnan(a) && std::isnan(b)));
    }
    return count;
  };
  EXPECT_EQ(differ(take(1)), 0);
  EXPECT_GT(differ(take(2)), 1000);
}

}  // namespace
}  // namespace cmn
