// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/hit_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cmn {

HitField::HitField(const CoarseMap& map, double margin_m, double sigma_m, double floor)
    : margin_{static_cast<int>(std::ceil(margin_m / map.resolution())) + 3},
      stride_{map.width() + 2 * margin_} {
  const int height = map.height() + 2 * margin_;
  cv::Mat free(height, stride_, CV_8U, cv::Scalar{0});
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      free.at<std::uint8_t>(y + margin_, x + margin_) = map.is_free({x, y}) ? 255 : 0;
    }
  }
  cv::Mat near_free;
  cv::dilate(free, near_free, cv::Mat{});
  const cv::Mat no_surface = (free != 0) | (near_free == 0);
  cv::Mat distance;
  cv::distanceTransform(no_surface, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < stride_; ++x) {
      // To the border of the surface's cell, not to its middle.
      const double d_m =
          std::max(0.0, static_cast<double>(distance.at<float>(y, x)) - 0.5) * map.resolution();
      const double share = d_m / sigma_m;
      log_hit_.push_back(static_cast<float>(std::log(std::exp(-0.5 * share * share) + floor)));
      occupied_.push_back(free.at<std::uint8_t>(y, x) == 0 ? 1.0F : 0.0F);
    }
  }
}

}  // namespace cmn
