// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/texture.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

/// The texel that a coordinate falls on, of so many.
int repeated(float coordinate, int count) {
  const float share = coordinate - std::floor(coordinate);  // NaN and inf: NaN
  return share >= 0.0F ? std::min(count - 1, static_cast<int>(share * static_cast<float>(count)))
                       : 0;
}

}  // namespace

cv::Vec4b texel_at(const MeshScene& scene, const Hit& hit) {
  const Triangle& triangle = scene.triangles[hit.triangle];
  const Eigen::Vector2f p = (1.0F - hit.u - hit.v) * scene.texture_points[triangle.corners[0]] +
                            hit.u * scene.texture_points[triangle.corners[1]] +
                            hit.v * scene.texture_points[triangle.corners[2]];
  const cv::Mat& texture = scene.materials[triangle.material].texture;
  const int row = texture.rows - 1 - repeated(p.y(), texture.rows);
  return texture.at<cv::Vec4b>(row, repeated(p.x(), texture.cols));
}

cv::Vec3b colour_at(const MeshScene& scene, const Hit& hit) {
  const Material& material = scene.materials[scene.triangles[hit.triangle].material];
  if (!material.texture.empty()) {
    const cv::Vec4b texel = texel_at(scene, hit);
    return {texel[0], texel[1], texel[2]};
  }
  const Eigen::Vector3f c = 255.0F * material.colour.cwiseMax(0.0F).cwiseMin(1.0F);
  return {cv::saturate_cast<uchar>(c[2]), cv::saturate_cast<uchar>(c[1]),
          cv::saturate_cast<uchar>(c[0])};
}

cv::Mat texture_of(const cv::Mat& picture, int longest) {
  if (picture.empty() || (picture.depth() != CV_8U && picture.depth() != CV_16U) ||
      picture.channels() == 2 || picture.channels() > 4) {
    return {};
  }
  cv::Mat bytes = picture;
  if (picture.depth() == CV_16U) {
    picture.convertTo(bytes, CV_8U, 1.0 / 257.0);
  }
  cv::Mat texture;
  if (bytes.channels() == 4) {
    texture = bytes.clone();
  } else {
    cv::cvtColor(bytes, texture, bytes.channels() == 1 ? cv::COLOR_GRAY2BGRA : cv::COLOR_BGR2BGRA);
  }
  const double scale = static_cast<double>(longest) / std::max(texture.rows, texture.cols);
  if (scale < 1.0) {
    cv::resize(texture, texture, {}, scale, scale, cv::INTER_AREA);
  }
  return texture;
}

}  // namespace cmn
