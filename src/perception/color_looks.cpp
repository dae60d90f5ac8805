// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/color_looks.hpp"

#include <cmath>
#include <cstddef>

namespace cmn {
namespace {

/// Which way the camera looks, seen from the robot.
double yaw_of(const Eigen::Isometry3d& T_robot_camera) {
  const Eigen::Vector3d ahead = T_robot_camera.linear().col(2);
  return std::atan2(ahead.y(), ahead.x());
}

/// A level optical frame that looks that way; columns: x to the right, y down, z ahead.
Eigen::Matrix3d level_frame(double yaw_rad) {
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  Eigen::Matrix3d R_robot_level;
  R_robot_level << s, 0.0, c, -c, 0.0, s, 0.0, -1.0, 0.0;
  return R_robot_level;
}

/// The place of a view that looks so far to the left of where the robot faces.
std::size_t place_of(double left_rad) {
  return static_cast<std::size_t>((nearest_quarter(wrap_angle(left_rad)) + 4) % 4);
}

}  // namespace

ColorPanorama ColorLooks::add(const ColorImage& image, const Pose2& T_odom_robot) {
  const double camera_yaw_rad = yaw_of(image.T_robot_camera);
  const Eigen::Matrix3d R_level_camera =
      level_frame(camera_yaw_rad).transpose() * image.T_robot_camera.linear();
  const cv::Mat view = level_view(image.bgr, image.camera, R_level_camera);
  ColorPanorama panorama;
  panorama.stamp_s = image.stamp_s;
  if (!turns_round_) {
    panorama.views[place_of(camera_yaw_rad)] = view;
    return panorama;
  }
  around_.add(view, T_odom_robot);
  for (const auto& look : around_.looks()) {
    const double turned_rad = wrap_angle(look.T_odom_robot.yaw - T_odom_robot.yaw);
    // A robot that started between its axes has looked at headings of other axes, too.
    const double off_rad = turned_rad - nearest_quarter(turned_rad) * kPi / 2.0;
    if (std::abs(off_rad) < LooksAround<cv::Mat>::kHeading_rad) {
      panorama.views[place_of(turned_rad + camera_yaw_rad)] = look.seen;
    }
  }
  return panorama;
}

}  // namespace cmn
