// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/color_panorama.hpp"

#include "coarse_map_nav/data/geometry.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

Eigen::Matrix3d intrinsics(const CameraModel& camera) {
  Eigen::Matrix3d intrinsics;
  intrinsics << camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0;
  return intrinsics;
}

/// The model of the same camera with its image resized.
CameraModel resized(const CameraModel& camera, cv::Size size) {
  const double sx = static_cast<double>(size.width) / camera.width;
  const double sy = static_cast<double>(size.height) / camera.height;
  return {size.width,
          size.height,
          sx * camera.fx,
          sy * camera.fy,
          sx * (camera.cx + 0.5) - 0.5,
          sy * (camera.cy + 0.5) - 0.5};
}

}  // namespace

ColorPanorama::ColorPanorama() {
  for (cv::Mat& view : views) {
    view = cv::Mat::zeros(kViewSide, kViewSide, CV_8UC3);
  }
}

CameraModel panorama_camera() {
  return CameraModel::from_field_of_view(kViewSide, kViewSide, kPi / 2.0);
}

cv::Mat level_view(const cv::Mat& image, const CameraModel& camera,
                   const Eigen::Matrix3d& R_level_camera) {
  assert(image.type() == CV_8UC3 && image.cols == camera.width && image.rows == camera.height);
  const CameraModel level = panorama_camera();
  const auto thinned = [](int pixels, double f, double wanted_f) {
    return std::max(1, cvRound(pixels * std::min(1.0, wanted_f / f)));
  };
  const cv::Size size{thinned(camera.width, camera.fx, level.fx),
                      thinned(camera.height, camera.fy, level.fy)};
  cv::Mat source;
  cv::resize(image, source, size, 0.0, 0.0, cv::INTER_AREA);
  // Where a ray of the level view meets the image; behind the image plane there is no pixel.
  const Eigen::Matrix3d homography =
      intrinsics(resized(camera, size)) * R_level_camera.transpose() * intrinsics(level).inverse();
  cv::Mat_<cv::Vec2f> from(kViewSide, kViewSide);
  for (int v = 0; v < kViewSide; ++v) {
    for (int u = 0; u < kViewSide; ++u) {
      const Eigen::Vector3d p = homography * Eigen::Vector3d{u * 1.0, v * 1.0, 1.0};
      from(v, u) = p.z() > 1e-6 ? cv::Vec2f{static_cast<float>(p.x() / p.z()),
                                            static_cast<float>(p.y() / p.z())}
                                : cv::Vec2f{-10.0F, -10.0F};
    }
  }
  cv::Mat view;
  cv::remap(source, view, from, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT,
            cv::Scalar::all(0));
  return view;
}

bool is_in_view(const ColorPanorama& panorama, double bearing_rad) {
  const int quarter = nearest_quarter(wrap_angle(bearing_rad));
  const cv::Mat& view = panorama.views[static_cast<std::size_t>((quarter + 4) % 4)];
  const CameraModel camera = panorama_camera();
  const double u = camera.cx - camera.fx * std::tan(bearing_rad - quarter * kPi / 2.0);
  const cv::Mat column = view.col(std::clamp(cvRound(u), 0, kViewSide - 1));
  return cv::norm(column, cv::NORM_INF) > 0.0;
}

ColorPanorama turned(const ColorPanorama& panorama, int quarter_turns) {
  ColorPanorama result;
  result.stamp_s = panorama.stamp_s;
  for (std::size_t k = 0; k < kViewCount; ++k) {
    const Heading looks = turned(static_cast<Heading>(k), quarter_turns);
    result.views[k] = panorama.views[static_cast<std::size_t>(index(looks))];
  }
  return result;
}

}  // namespace cmn
