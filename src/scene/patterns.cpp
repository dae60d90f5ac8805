// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/patterns.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr int kSide = 256;  ///< [texels]

cv::Scalar shade(const cv::Scalar& colour, double factor) {
  return {colour[0] * factor, colour[1] * factor, colour[2] * factor, 255.0};
}

cv::Mat grained(const cv::Mat& pattern, std::mt19937_64& rng, double strength, cv::Size grain) {
  cv::Mat noise(pattern.size(), CV_32FC1);
  cv::RNG{rng() | 1U}.fill(noise, cv::RNG::NORMAL, 0.0, strength);
  cv::blur(noise, noise, grain);
  cv::Mat made = pattern.clone();
  for (int row = 0; row < made.rows; ++row) {
    for (int column = 0; column < made.cols; ++column) {
      auto& texel = made.at<cv::Vec4b>(row, column);
      for (int channel = 0; channel < 3; ++channel) {
        texel[channel] = cv::saturate_cast<uchar>(texel[channel] + noise.at<float>(row, column));
      }
    }
  }
  return made;
}

}  // namespace

cv::Mat plank_pattern(std::mt19937_64& rng) {
  constexpr int kPlanks = 16;
  const double light = 90.0 + 110.0 * draw_uniform(rng);
  const cv::Scalar wood{light * (0.45 + 0.2 * draw_uniform(rng)),
                        light * (0.7 + 0.1 * draw_uniform(rng)), light};
  cv::Mat pattern(kSide, kSide, CV_8UC4);
  const int height = kSide / kPlanks;
  for (int i = 0; i < kPlanks; ++i) {
    const int top = i * height;
    const int joint = static_cast<int>(draw_index(rng, kSide));
    for (const auto& [left, right] : {std::pair{0, joint}, std::pair{joint, kSide}}) {
      cv::rectangle(pattern, {left, top}, {right, top + height},
                    shade(wood, 0.88 + 0.24 * draw_uniform(rng)), cv::FILLED);
    }
    cv::line(pattern, {joint, top}, {joint, top + height}, shade(wood, 0.6));
    cv::line(pattern, {0, top}, {kSide, top}, shade(wood, 0.6));
  }
  return grained(pattern, rng, 40.0, {15, 1});
}

cv::Mat tile_pattern(std::mt19937_64& rng) {
  const int count = 4 + 2 * static_cast<int>(draw_index(rng, 2));
  const double light = 110.0 + 120.0 * draw_uniform(rng);
  const cv::Scalar glaze{light * (0.85 + 0.15 * draw_uniform(rng)),
                         light * (0.9 + 0.1 * draw_uniform(rng)), light};
  cv::Mat pattern(kSide, kSide, CV_8UC4, shade(glaze, 0.7));
  for (int i = 0; i < count * count; ++i) {
    const int left = i % count * kSide / count + 1;
    const int top = i / count * kSide / count + 1;
    const int side = kSide / count - 3;
    cv::rectangle(pattern, {left, top, side, side}, shade(glaze, 0.96 + 0.08 * draw_uniform(rng)),
                  cv::FILLED);
  }
  return grained(pattern, rng, 12.0, {3, 3});
}

}  // namespace cmn
