// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/depth_projection.hpp"

#include "coarse_map_nav/data/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "depth_points.hpp"

namespace cmn {
namespace {

constexpr std::size_t kMostSamples = 6000;  ///< about, to look for the floor among

/// The point of the floor under a camera, with the yaw of the optical axis.
Pose2 ground_pose(const Eigen::Isometry3d& T_robot_camera) {
  const Eigen::Vector3d p = T_robot_camera.translation();
  const Eigen::Vector3d axis = T_robot_camera.linear().col(2);
  return {p.x(), p.y(), std::atan2(axis.y(), axis.x())};
}

FloorView view_from(const Pose2& ground, const Eigen::Isometry3d& T_robot_camera) {
  const Eigen::AngleAxisd back{-ground.yaw, Eigen::Vector3d::UnitZ()};
  return {(back.toRotationMatrix() * T_robot_camera.linear()).cast<float>(),
          static_cast<float>(T_robot_camera.translation().z())};
}

/// Least and greatest bearing of the image in the scan's frame; all of them when it looks up or
/// down.
std::array<double, 2> bearings_of(const CameraModel& camera, const Eigen::Matrix3f& turn) {
  const Eigen::Vector3f down = turn.row(2).transpose();  // or up, in the camera's frame
  if (std::abs(down.z()) > 1e-6F) {
    const double u = static_cast<double>(down.x() / down.z()) * camera.fx + camera.cx;
    const double v = static_cast<double>(down.y() / down.z()) * camera.fy + camera.cy;
    if (u > -1.0 && v > -1.0 && u < camera.width && v < camera.height) {
      return {-kPi, kPi};
    }
  }
  std::array<double, 2> range{kPi, -kPi};
  const auto look_at = [&](int u, int v) {
    const Eigen::Vector3f ray{static_cast<float>((u - camera.cx) / camera.fx),
                              static_cast<float>((v - camera.cy) / camera.fy), 1.0F};
    const Eigen::Vector3d p = (turn * ray).cast<double>();
    const double bearing = std::atan2(p.y(), p.x());
    range = {std::min(range[0], bearing), std::max(range[1], bearing)};
  };
  for (int u = 0; u < camera.width; ++u) {
    look_at(u, 0);
    look_at(u, camera.height - 1);
  }
  for (int v = 0; v < camera.height; ++v) {
    look_at(0, v);
    look_at(camera.width - 1, v);
  }
  return range;
}

/// A scan of no ranges yet, with bearings at whole increments from `range[0]` to `range[1]`.
RangeScan layout_of(double increment_rad, std::array<double, 2> range, const DepthParams& params) {
  RangeScan scan;
  const double most = std::floor(2.0 * kPi / increment_rad + 1e-9);
  const double first = std::floor(range[0] / increment_rad);
  const double beams = std::min(most, std::ceil(range[1] / increment_rad) - first + 1.0);
  scan.angle_increment_rad = increment_rad;
  scan.angle_min_rad = first * increment_rad;
  scan.range_max_m = params.range_max_m;
  scan.source = ObservationSource::kDepth;
  scan.ranges_m.assign(static_cast<std::size_t>(beams), std::numeric_limits<float>::quiet_NaN());
  scan.sights.assign(scan.ranges_m.size(), {});
  return scan;
}

}  // namespace

RangeScan DepthProjector::scan(const DepthImage& image) {
  const double pixel_rad = 1.2 / std::min(image.camera.fx, image.camera.fy);
  const double increment_rad = std::max(params_.increment_deg * kPi / 180.0, pixel_rad);
  const Pose2 ground = ground_pose(image.T_robot_camera);
  const FloorView view = view_from(ground, image.T_robot_camera);
  RangeScan scan = layout_of(increment_rad, bearings_of(image.camera, view.turn), params_);
  scan.stamp_s = image.stamp_s;
  scan.T_robot_sensor = ground;
  fill(scan, ImagePoints{image}, view);
  return scan;
}

RangeScan DepthProjector::scan(const PointCloudView& cloud) {
  const Eigen::Vector3d origin = cloud.T_robot_camera.translation();
  const Pose2 ground{origin.x(), origin.y(), 0.0};
  RangeScan scan = layout_of(params_.increment_deg * kPi / 180.0, {-kPi, kPi}, params_);
  scan.stamp_s = cloud.stamp_s;
  scan.T_robot_sensor = ground;
  fill(scan, CloudPoints{cloud}, view_from(ground, cloud.T_robot_camera));
  return scan;
}

template <class Points>
void DepthProjector::fill(RangeScan& scan, Points points, const FloorView& nominal) {
  report_ = {};
  report_.plane = floor_of(points, nominal);
  report_.floor = floor_.source();
  const FloorView view = nominal.over(report_.plane);
  counts_.begin(scan);
  piece_.is_row = points.has_rows();
  for (std::size_t v = 0; v < points.height(); ++v) {
    for (std::size_t first = 0; first < points.width(); first += PointPiece::kMost) {
      piece_.count = std::min(PointPiece::kMost, points.width() - first);
      points.read(v, first, view, piece_);
      counts_.add(piece_, report_);
    }
  }
  report_.unusable = points.width() * points.height() - report_.points;
  counts_.read_out(scan, report_);
}

template <class Points>
FloorPlane DepthProjector::floor_of(const Points& points, const FloorView& nominal) {
  candidates_.clear();
  const double count = static_cast<double>(points.width()) * static_cast<double>(points.height());
  const double every = std::max(1.0, count / static_cast<double>(kMostSamples));
  const bool has_rows = points.height() > 1;
  const auto step_v = static_cast<std::size_t>(has_rows ? std::ceil(std::sqrt(every)) : 1.0);
  const auto step_u = static_cast<std::size_t>(has_rows ? std::ceil(std::sqrt(every)) : every);
  for (std::size_t v = step_v / 2; v < points.height(); v += step_v) {
    for (std::size_t u = step_u / 2; u < points.width(); u += step_u) {
      const Eigen::Vector3f p = nominal * points.at(u, v);
      if (floor_.is_candidate(p)) {
        candidates_.push_back(p);
      }
    }
  }
  return floor_.fit(candidates_);
}

}  // namespace cmn
