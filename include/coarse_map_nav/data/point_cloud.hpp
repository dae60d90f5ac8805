// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A point cloud as it lies in a message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <Eigen/Geometry>

namespace cmn {

/// Where a coordinate lies in a point: a float or double of this machine's byte order.
struct PointField {
  std::size_t offset = 0;  ///< [bytes]
  bool is_double = false;
};

/// Points of a sensor_msgs/PointCloud2, not owned. Row v of `height` begins at byte v * row_step,
/// its points follow at every point_step bytes. The maker has seen to it that all of them lie
/// within `data`. Any coordinate may be NaN: no reading.
struct PointCloudView {
  double stamp_s = 0.0;
  const std::uint8_t* data = nullptr;
  std::size_t width = 0;
  std::size_t height = 0;      ///< 1: the points have no order
  std::size_t point_step = 0;  ///< [bytes]
  std::size_t row_step = 0;    ///< [bytes]
  PointField x, y, z;          ///< [m] in the cloud's frame, whose origin is the camera
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();  ///< base_link <- that frame
};

/// One coordinate of a point; `point` need not be aligned.
inline float coordinate_of(const std::uint8_t* point, PointField field) {
  if (field.is_double) {
    double value = 0.0;
    std::memcpy(&value, point + field.offset, sizeof value);
    return static_cast<float>(value);
  }
  float value = 0.0F;
  std::memcpy(&value, point + field.offset, sizeof value);
  return value;
}

}  // namespace cmn
