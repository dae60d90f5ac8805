// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/color_panorama.hpp"

#include "coarse_map_nav/data/geometry.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

/// What a camera with that mount sees of a world that is blue above the horizon, green below, red
/// to the right of straight ahead.
cv::Mat seen_by(const CameraModel& camera, const Eigen::Matrix3d& R_level_camera) {
  cv::Mat image(camera.height, camera.width, CV_8UC3);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray =
          R_level_camera *
          Eigen::Vector3d{(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1.0};
      image.at<cv::Vec3b>(v, u) =
          cv::Vec3b(ray.y() < 0.0 ? 200 : 0, ray.y() < 0.0 ? 0 : 200, ray.x() > 0.0 ? 200 : 0);
    }
  }
  return image;
}

/// Pixels of the middle that are another colour than the right camera's: at most those at borders.
int pixels_off(const cv::Mat& view, const cv::Mat& expected, const cv::Rect& area) {
  cv::Mat difference;
  cv::absdiff(view(area), expected(area), difference);
  cv::Mat largest;
  cv::reduce(difference.reshape(1, static_cast<int>(difference.total())), largest, 1,
             cv::REDUCE_MAX);
  return cv::countNonZero(largest > 100);
}

TEST(ColorPanorama, ItsOwnCameraSeesNinetyDegrees) {
  const CameraModel camera = panorama_camera();
  EXPECT_DOUBLE_EQ(camera.fx, 40.0);
  EXPECT_NEAR(camera.horizontal_field_of_view_rad(), kPi / 2.0, 1e-12);
}

TEST(ColorPanorama, AnImageOfItsOwnCameraStaysAsItIs) {
  const cv::Mat image = seen_by(panorama_camera(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(cv::norm(level_view(image, panorama_camera()), image, cv::NORM_INF), 0.0);
}

TEST(ColorPanorama, ANarrowCameraLeavesBlackBorders) {
  const CameraModel narrow = CameraModel::from_field_of_view(640, 480, kPi / 3.0);
  const cv::Mat view = level_view(seen_by(narrow, Eigen::Matrix3d::Identity()), narrow);
  // tan(30 deg) of 40 pixels to each side.
  const int half = static_cast<int>(40.0 * std::tan(kPi / 6.0));
  EXPECT_EQ(view.at<cv::Vec3b>(30, 40 - half - 2), (cv::Vec3b{0, 0, 0}));
  EXPECT_EQ(view.at<cv::Vec3b>(30, 40 + half + 1), (cv::Vec3b{0, 0, 0}));
  EXPECT_NE(view.at<cv::Vec3b>(30, 40 - half + 1), (cv::Vec3b{0, 0, 0}));
  const cv::Mat expected = seen_by(panorama_camera(), Eigen::Matrix3d::Identity());
  EXPECT_LE(pixels_off(view, expected, {20, 30, 40, 20}), 4);
}

TEST(ColorPanorama, ATiltedCameraIsLevelled) {
  const CameraModel camera = CameraModel::from_field_of_view(320, 240, 1.3);
  // Down by 15 degrees: about the x axis, from z towards y.
  const Eigen::Matrix3d tilt =
      Eigen::AngleAxisd{-15.0 * kPi / 180.0, Eigen::Vector3d::UnitX()}.toRotationMatrix();
  ASSERT_GT((tilt * Eigen::Vector3d::UnitZ()).y(), 0.0);
  const cv::Mat view = level_view(seen_by(camera, tilt), camera, tilt);
  const cv::Mat expected = seen_by(panorama_camera(), Eigen::Matrix3d::Identity());
  EXPECT_LE(pixels_off(view, expected, {20, 32, 40, 30}), 4);
}

TEST(ColorPanorama, TurningLeftPutsTheLeftViewInFront) {
  ColorPanorama panorama;
  for (std::size_t k = 0; k < kViewCount; ++k) {
    panorama.views[k].setTo(cv::Scalar::all(10.0 * static_cast<double>(k)));
  }
  const ColorPanorama left = turned(panorama, 1);
  EXPECT_EQ(left.views[0].at<cv::Vec3b>(0, 0)[0], 10);
  EXPECT_EQ(left.views[3].at<cv::Vec3b>(0, 0)[0], 0);
  const ColorPanorama back = turned(left, -1);
  EXPECT_EQ(back.views[0].at<cv::Vec3b>(0, 0)[0], 0);
}

}  // namespace
}  // namespace cmn
