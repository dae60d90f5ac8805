// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Messages of cameras <-> core types. What is malformed comes back empty, with a reason.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/point_cloud.hpp"

#include <optional>
#include <string>

#include <Eigen/Geometry>
#include <geometry_msgs/Transform.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

namespace cmn {

/// Empty when it holds no rotation or numbers that are none.
std::optional<Eigen::Isometry3d> isometry_of(const geometry_msgs::Transform& transform);

/// The cloud's own bytes: good as long as the message is. Any order of fields, of float32 or
/// float64, with whatever lies between them; x, y and z in metres.
std::optional<PointCloudView> view_of(const sensor_msgs::PointCloud2& cloud,
                                      const Eigen::Isometry3d& T_robot_camera, std::string& why);

/// The pinhole of a rectified image (K).
std::optional<CameraModel> camera_of(const sensor_msgs::CameraInfo& info, std::string& why);

/// 16UC1 in millimetres or 32FC1 in metres, as REP-118 has it, copied.
std::optional<DepthImage> depth_of(const sensor_msgs::Image& image, const CameraModel& camera,
                                   const Eigen::Isometry3d& T_robot_camera, std::string& why);

/// Any encoding that cv_bridge makes BGR of (RGB, grey, Bayer, YUV; 16 bits are halved), copied.
std::optional<ColorImage> color_of(const sensor_msgs::Image& image, const CameraModel& camera,
                                   const Eigen::Isometry3d& T_robot_camera, std::string& why);

sensor_msgs::CameraInfo message_of(const CameraModel& camera, const std_msgs::Header& header);
/// 32FC1 in metres; holes are NaN.
sensor_msgs::Image message_of(const DepthImage& depth, const std_msgs::Header& header);
/// A point a pixel, in their order: x, y, z of float32 in the optical frame; holes are NaN.
sensor_msgs::PointCloud2 cloud_of(const DepthImage& depth, const std_msgs::Header& header);

}  // namespace cmn
