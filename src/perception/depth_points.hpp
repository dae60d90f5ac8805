// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The points of depth images and clouds, a piece of a row at a time.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/point_cloud.hpp"
#include "coarse_map_nav/perception/polar_counts.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace cmn {

/// From a camera's axes to those of its scan, with heights over the floor.
struct FloorView {
  Eigen::Matrix3f turn;
  float height_m;  ///< of the camera

  Eigen::Vector3f operator*(const Eigen::Vector3f& p) const {
    return turn * p + Eigen::Vector3f{0.0F, 0.0F, height_m};
  }
  /// With heights over a floor that is not where this one has it.
  FloorView over(const FloorPlane& plane) const {
    FloorView view = *this;
    view.turn.row(2) -= plane.slope.x() * turn.row(0) + plane.slope.y() * turn.row(1);
    view.height_m -= plane.offset_m;
    return view;
  }
};

class ImagePoints {
 public:
  explicit ImagePoints(const DepthImage& image)
      : image_{image}, right_(static_cast<std::size_t>(image.camera.width)) {
    for (std::size_t u = 0; u < right_.size(); ++u) {
      right_[u] = static_cast<float>((static_cast<double>(u) - image.camera.cx) / image.camera.fx);
    }
  }
  std::size_t width() const { return right_.size(); }
  std::size_t height() const { return static_cast<std::size_t>(image_.camera.height); }
  bool has_rows() const { return true; }

  Eigen::Vector3f at(std::size_t u, std::size_t v) const {
    return usable(image_.depth_m.ptr<float>(static_cast<int>(v))[u]) *
           Eigen::Vector3f{right_[u], down(v), 1.0F};
  }
  /// Fills in piece.count points from `first` on.
  void read(std::size_t v, std::size_t first, const FloorView& view, PointPiece& piece) const {
    const float* depths = image_.depth_m.ptr<float>(static_cast<int>(v)) + first;
    const float* right = right_.data() + first;
    const Eigen::Vector3f across = view.turn.col(0);
    const Eigen::Vector3f middle = view.turn * Eigen::Vector3f{0.0F, down(v), 1.0F};
    const float ax = across.x(), ay = across.y(), az = across.z();
    const float mx = middle.x(), my = middle.y(), mz = middle.z();
    for (std::size_t i = 0; i < piece.count; ++i) {
      const float depth = usable(depths[i]);
      piece.x[i] = depth * (mx + ax * right[i]);
      piece.y[i] = depth * (my + ay * right[i]);
      piece.height_m[i] = depth * (mz + az * right[i]) + view.height_m;
    }
  }

 private:
  static float usable(float depth) {
    return depth > 0.0F ? depth : std::numeric_limits<float>::quiet_NaN();
  }
  float down(std::size_t v) const {
    return static_cast<float>((static_cast<double>(v) - image_.camera.cy) / image_.camera.fy);
  }
  const DepthImage& image_;
  std::vector<float> right_;  ///< of a column, at depth 1
};

class CloudPoints {
 public:
  explicit CloudPoints(const PointCloudView& cloud) : cloud_{cloud} {
    const std::size_t x = cloud.x.offset;
    const bool are_together = !cloud.x.is_double && !cloud.y.is_double && !cloud.z.is_double &&
                              cloud.y.offset == x + sizeof(float) &&
                              cloud.z.offset == x + 2 * sizeof(float);
    // One that needs no packing fills its 16 bytes, and those with more may be copied as 16.
    has_packed_ = are_together && cloud.point_step == kPacked;
    has_copyable_ = are_together && cloud.point_step >= x + kPacked;
  }
  std::size_t width() const { return cloud_.width; }
  std::size_t height() const { return cloud_.height; }
  bool has_rows() const { return cloud_.height > 1; }

  Eigen::Vector3f at(std::size_t u, std::size_t v) const {
    const std::uint8_t* point = cloud_.data + v * cloud_.row_step + u * cloud_.point_step;
    return {coordinate_of(point, cloud_.x), coordinate_of(point, cloud_.y),
            coordinate_of(point, cloud_.z)};
  }
  /// Fills in piece.count points from `first` on.
  void read(std::size_t v, std::size_t first, const FloorView& view, PointPiece& piece) {
    const std::uint8_t* from = cloud_.data + v * cloud_.row_step + first * cloud_.point_step;
    if (has_packed_) {
      turn(from + cloud_.x.offset, view, piece);
      return;
    }
    std::uint8_t* to = packed_.data();
    if (has_copyable_) {
      from += cloud_.x.offset;
      for (std::size_t i = 0; i < piece.count; ++i) {
        std::memcpy(to + i * kPacked, from + i * cloud_.point_step, kPacked);
      }
    } else {
      for (std::size_t i = 0; i < piece.count; ++i, from += cloud_.point_step) {
        const float point[3]{coordinate_of(from, cloud_.x), coordinate_of(from, cloud_.y),
                             coordinate_of(from, cloud_.z)};
        std::memcpy(to + i * kPacked, point, sizeof point);
      }
    }
    turn(to, view, piece);
  }

 private:
  /// [bytes] between points whose three floats are followed by anything: the compiler, which knows
  /// it, reads four points by four loads.
  static constexpr std::size_t kPacked = 16;

  static void turn(const std::uint8_t* packed, const FloorView& view, PointPiece& piece) {
    const Eigen::Matrix3f m = view.turn;
    const float xx = m(0, 0), xy = m(0, 1), xz = m(0, 2);
    const float yx = m(1, 0), yy = m(1, 1), yz = m(1, 2);
    const float zx = m(2, 0), zy = m(2, 1), zz = m(2, 2);
    const float height_m = view.height_m;
    for (std::size_t i = 0; i < piece.count; ++i) {
      float x = 0.0F, y = 0.0F, z = 0.0F;
      std::memcpy(&x, packed + i * kPacked, sizeof x);
      std::memcpy(&y, packed + i * kPacked + 4, sizeof y);
      std::memcpy(&z, packed + i * kPacked + 8, sizeof z);
      piece.x[i] = xx * x + xy * y + xz * z;
      piece.y[i] = yx * x + yy * y + yz * z;
      piece.height_m[i] = zx * x + zy * y + zz * z + height_m;
    }
  }

  const PointCloudView& cloud_;
  bool has_packed_ = false;
  bool has_copyable_ = false;
  std::array<std::uint8_t, PointPiece::kMost * kPacked> packed_;
};

}  // namespace cmn
