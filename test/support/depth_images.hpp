// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Depth images as cameras take them, and as point clouds.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/point_cloud.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

namespace cmn {

/// As a RealSense measures: an error that grows with the square of the depth (2 mm at 1 m), and
/// readings that are missing.
inline DepthImage noisy(DepthImage image, std::uint32_t seed) {
  std::mt19937 rng{seed};
  std::normal_distribution<float> normal;
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) {
      float& depth = image.depth_m.at<float>(v, u);
      depth = rng() % 50 == 0 ? 0.0F : depth + 0.002F * depth * depth * normal(rng);
    }
  }
  return image;
}

/// The image as points of `point_step` bytes in the optical frame; NaN without a reading.
inline std::vector<std::uint8_t> cloud_bytes_of(const DepthImage& image, std::size_t point_step) {
  std::vector<std::uint8_t> bytes(image.depth_m.total() * point_step);
  std::uint8_t* to = bytes.data();
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u, to += point_step) {
      const float read = image.depth_m.at<float>(v, u);
      const float depth = read > 0.0F ? read : NAN;
      const float point[3]{static_cast<float>((u - image.camera.cx) / image.camera.fx) * depth,
                           static_cast<float>((v - image.camera.cy) / image.camera.fy) * depth,
                           depth};
      std::memcpy(to, point, sizeof point);
    }
  }
  return bytes;
}

inline PointCloudView view_of(const std::vector<std::uint8_t>& bytes, const DepthImage& image,
                              std::size_t point_step, bool is_organised) {
  PointCloudView cloud;
  cloud.data = bytes.data();
  cloud.height = is_organised ? static_cast<std::size_t>(image.camera.height) : 1;
  cloud.width = image.depth_m.total() / cloud.height;
  cloud.point_step = point_step;
  cloud.row_step = cloud.width * point_step;
  cloud.x.offset = 0;
  cloud.y.offset = 4;
  cloud.z.offset = 8;
  cloud.T_robot_camera = image.T_robot_camera;
  return cloud;
}

}  // namespace cmn
