// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/color_looks.hpp"

#include <cmath>

#include "box_room.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

ColorImage image_of(const cv::Scalar& colour, const Eigen::Isometry3d& T_robot_camera,
                    const CameraModel& camera = panorama_camera()) {
  return {7.0, camera, T_robot_camera, cv::Mat(camera.height, camera.width, CV_8UC3, colour)};
}
ColorImage red_image(int red) { return image_of({0, 0, red * 1.0}, camera_mount(0.1, 0.5, 0.0)); }

int red_of(const cv::Mat& view) { return view.at<cv::Vec3b>(kViewSide / 2, kViewSide / 2)[2]; }
std::array<int, 4> reds_of(const ColorPanorama& panorama) {
  return {red_of(panorama.views[0]), red_of(panorama.views[1]), red_of(panorama.views[2]),
          red_of(panorama.views[3])};
}
using Reds = std::array<int, 4>;

Pose2 facing(int quarter, double error_rad = 0.0) {
  return {1.0, 2.0, wrap_angle(quarter * kPi / 2.0 + error_rad)};
}

TEST(ColorLooks, FourLooksMakeAPanoramaThatTurnsWithTheRobot) {
  ColorLooks looks{true};
  for (int turn = 0; turn < 4; ++turn) {
    looks.add(red_image(10 + turn), facing(turn, 0.02 * turn));
    EXPECT_FALSE(looks.is_complete()) << turn;
  }
  const ColorPanorama panorama = looks.add(red_image(20), facing(4));
  EXPECT_TRUE(looks.is_complete());
  EXPECT_EQ(reds_of(panorama), (Reds{20, 11, 12, 13})) << "the new look ahead, the others as made";
  EXPECT_EQ(panorama.stamp_s, 7.0);
  EXPECT_EQ(reds_of(looks.add(red_image(21), facing(5))), (Reds{21, 12, 13, 20}));
  EXPECT_TRUE(looks.is_complete());
  EXPECT_EQ(reds_of(looks.add(red_image(30), {1.2, 2.0, 0.0})), (Reds{30, 0, 0, 0}));
  EXPECT_FALSE(looks.is_complete()) << "a step away";
  looks.forget();
  EXPECT_FALSE(looks.is_complete());
}

TEST(ColorLooks, LooksOfOtherAxesAreNotPartOfThePanorama) {
  ColorLooks looks{true};
  looks.add(red_image(99), facing(0, 0.6));  // where it started, before it turned onto its axes
  ColorPanorama panorama;
  for (int turn = 1; turn < 6 && !looks.is_complete(); ++turn) {
    panorama = looks.add(red_image(10 + turn), facing(turn));
  }
  ASSERT_TRUE(looks.is_complete());
  EXPECT_EQ(reds_of(panorama), (Reds{15, 12, 13, 14}));
}

TEST(ColorLooks, WithoutTurningAnImageIsAllThereIs) {
  ColorLooks looks{false};
  EXPECT_EQ(reds_of(looks.add(red_image(10), facing(0))), (Reds{10, 0, 0, 0}));
  EXPECT_TRUE(looks.is_complete());
  EXPECT_EQ(reds_of(looks.add(red_image(11), facing(1))), (Reds{11, 0, 0, 0}));
}

TEST(ColorLooks, ACameraThatLooksToTheSideFillsThatView) {
  ColorLooks looks{false};
  const Eigen::Isometry3d to_the_left =
      Eigen::AngleAxisd{kPi / 2.0, Eigen::Vector3d::UnitZ()} * camera_mount(0.1, 0.5, 0.0);
  EXPECT_EQ(reds_of(looks.add(image_of({0, 0, 10}, to_the_left), facing(0))), (Reds{0, 10, 0, 0}));
}

TEST(ColorLooks, ATiltedCameraSeesTheHorizonWhereALevelOneDoes) {
  // A camera that looks down by 0.3 rad has the horizon above its middle; red above, green below.
  constexpr double kDown_rad = 0.3;
  const CameraModel camera = CameraModel::from_field_of_view(320, 240, 1.5);
  ColorImage image = image_of({0, 255, 0}, camera_mount(0.1, 0.5, kDown_rad), camera);
  const int horizon = cvRound(camera.cy - camera.fy * std::tan(kDown_rad));
  image.bgr.rowRange(0, horizon).setTo(cv::Scalar{0, 0, 255});
  const cv::Mat view = ColorLooks{false}.add(image, {}).views[0];
  const int middle = kViewSide / 2;
  EXPECT_GT(view.at<cv::Vec3b>(middle - 4, middle)[2], 200) << "above the horizon";
  EXPECT_GT(view.at<cv::Vec3b>(middle + 3, middle)[1], 200) << "below it";
}

}  // namespace
}  // namespace cmn
