// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A floor with boxes on it, and what a depth camera and a LiDAR see of them, worked out exactly.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

namespace cmn {

struct Box {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
};

/// Four walls, a box of 0.3 m, a post and a table of which a LiDAR sees only the legs.
inline std::vector<Box> furnished_room() {
  std::vector<Box> boxes{{{-3, 2.5, 0}, {3, 2.6, 2.5}},         {{-3, -2.1, 0}, {3, -2.0, 2.5}},
                         {{2.5, -3, 0}, {2.6, 3, 2.5}},         {{-3.1, -3, 0}, {-3.0, 3, 2.5}},
                         {{1.4, 0.9, 0}, {1.8, 1.5, 0.3}},      {{-1.6, 1.2, 0}, {-1.5, 1.3, 1.5}},
                         {{1.3, -1.5, 0.70}, {2.1, -0.7, 0.74}}};  // the table's top
  for (const double x : {1.3, 2.05}) {
    for (const double y : {-1.5, -0.75}) {
      boxes.push_back({{x, y, 0}, {x + 0.05, y + 0.05, 0.70}});
    }
  }
  return boxes;
}

/// The way along a direction (any length, in its units) to the first surface; inf without one.
inline double cast_at_boxes(const std::vector<Box>& boxes, const Eigen::Vector3d& from,
                            const Eigen::Vector3d& along) {
  double nearest = along.z() < 0.0 ? -from.z() / along.z() : HUGE_VAL;  // the floor
  for (const Box& box : boxes) {
    double in = 0.0;
    double out = nearest;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (box.low[axis] - from[axis]) / along[axis];
      const double b = (box.high[axis] - from[axis]) / along[axis];
      in = std::max(in, std::min(a, b));
      out = std::min(out, std::max(a, b));
    }
    nearest = in < out ? in : nearest;
  }
  return nearest;
}

inline Eigen::Isometry3d in_space(const Pose2& pose) {
  return Eigen::Translation3d{pose.x, pose.y, 0.0} *
         Eigen::AngleAxisd{pose.yaw, Eigen::Vector3d::UnitZ()};
}

/// Optical frame of a camera that looks ahead, `pitch_rad` down and rolled to the right.
inline Eigen::Isometry3d camera_mount(double x_m, double height_m, double pitch_rad,
                                      double roll_rad = 0.0) {
  Eigen::Matrix3d ahead;
  ahead << 0, 0, 1, -1, 0, 0, 0, -1, 0;  // columns: right, down, forward
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.linear() = (Eigen::AngleAxisd{pitch_rad, Eigen::Vector3d::UnitY()} *
                    Eigen::AngleAxisd{roll_rad, Eigen::Vector3d::UnitX()})
                       .toRotationMatrix() *
                   ahead;
  mount.translation() = Eigen::Vector3d{x_m, 0.0, height_m};
  return mount;
}

/// `T_robot_camera` is the true mount; the image says so too.
inline DepthImage depth_of_boxes(const std::vector<Box>& boxes, const CameraModel& camera,
                                 const Eigen::Isometry3d& T_robot_camera,
                                 const Pose2& T_world_robot) {
  DepthImage image;
  image.camera = camera;
  image.T_robot_camera = T_robot_camera;
  image.depth_m.create(camera.height, camera.width, CV_32FC1);
  const Eigen::Isometry3d T_world_camera = in_space(T_world_robot) * T_robot_camera;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray{(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1.0};
      image.depth_m.at<float>(v, u) = static_cast<float>(
          cast_at_boxes(boxes, T_world_camera.translation(), T_world_camera.linear() * ray));
    }
  }
  return image;
}

/// A noiseless LiDAR above the robot's middle.
inline RangeScan scan_of_boxes(const std::vector<Box>& boxes, double height_m, std::size_t beams,
                               const Pose2& T_world_robot) {
  RangeScan scan;
  scan.angle_min_rad = -kPi;
  scan.angle_increment_rad = 2.0 * kPi / static_cast<double>(beams);
  scan.range_max_m = 8.0;
  const Eigen::Isometry3d T_world_sensor = in_space(T_world_robot);
  for (std::size_t i = 0; i < beams; ++i) {
    const double bearing = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    const Eigen::Vector3d along{std::cos(bearing), std::sin(bearing), 0.0};
    scan.ranges_m.push_back(static_cast<float>(
        cast_at_boxes(boxes, T_world_sensor.translation() + height_m * Eigen::Vector3d::UnitZ(),
                      T_world_sensor.linear() * along)));
  }
  return scan;
}

}  // namespace cmn
