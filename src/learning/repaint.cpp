// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/learning/example_renderer.hpp"

#include <cmath>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr int kTextureSide = 256;

Eigen::Vector3f random_colour(std::mt19937_64& rng) {
  // Homes are mostly bright and pale.
  const double value = 0.25 + 0.7 * draw_uniform(rng);
  const double saturation = std::pow(draw_uniform(rng), 2.0);
  Eigen::Vector3f colour;
  for (int i = 0; i < 3; ++i) {
    colour[i] = static_cast<float>(value * (1.0 - saturation * draw_uniform(rng)));
  }
  return colour;
}

cv::Vec4b texel_of(const Eigen::Vector3f& colour, double factor) {
  const auto channel = [&](int i) { return cv::saturate_cast<uchar>(255.0 * factor * colour[i]); };
  return {channel(2), channel(1), channel(0), 255};
}

/// Smooth noise of mean 0, about as large as `amplitude`.
cv::Mat blotches(int cells, double amplitude, std::mt19937_64& rng) {
  cv::Mat coarse(cells, cells, CV_32FC1);
  for (int i = 0; i < cells * cells; ++i) {
    coarse.ptr<float>()[i] = static_cast<float>(amplitude * draw_normal(rng));
  }
  cv::Mat fine;
  cv::resize(coarse, fine, {kTextureSide, kTextureSide}, 0.0, 0.0, cv::INTER_CUBIC);
  return fine;
}

/// Bricks in rows: planks when they are long, tiles when they are square; joints are darker.
cv::Mat pattern(std::mt19937_64& rng) {
  const Eigen::Vector3f colour = random_colour(rng);
  const bool has_bricks = draw_index(rng, 3) != 0;
  const int rows = 2 + static_cast<int>(draw_index(rng, 30));
  const int columns = 1 + static_cast<int>(draw_index(rng, static_cast<std::size_t>(rows)));
  const bool is_staggered = draw_index(rng, 2) == 0;
  const double unlike = 0.3 * draw_uniform(rng);
  const cv::Mat grain =
      blotches(4 + static_cast<int>(draw_index(rng, 60)), 0.15 * draw_uniform(rng), rng);
  std::vector<double> shades(static_cast<std::size_t>(rows * columns));
  for (double& shade : shades) {
    shade = has_bricks ? 1.0 + unlike * (draw_uniform(rng) - 0.5) : 1.0;
  }
  cv::Mat texture(kTextureSide, kTextureSide, CV_8UC4);
  for (int y = 0; y < kTextureSide; ++y) {
    const int row = y * rows / kTextureSide;
    const int shift = is_staggered && row % 2 == 1 ? kTextureSide / columns / 2 : 0;
    for (int x = 0; x < kTextureSide; ++x) {
      const int along = (x + shift) % kTextureSide;
      const int column = along * columns / kTextureSide;
      const bool is_joint = has_bricks && (y * rows % kTextureSide < rows ||
                                           along * columns % kTextureSide < columns);
      const double shade =
          (is_joint ? 0.7 : 1.0) * shades[static_cast<std::size_t>(row * columns + column)] +
          grain.at<float>(y, x);
      texture.at<cv::Vec4b>(y, x) = texel_of(colour, shade);
    }
  }
  return texture;
}

/// Another hue and brightness; opacity stays.
cv::Mat tinted(const cv::Mat& texture, std::mt19937_64& rng) {
  const Eigen::Vector3f colour = random_colour(rng) / 0.6F;
  cv::Mat result;
  cv::multiply(texture, cv::Scalar(colour.z(), colour.y(), colour.x(), 1.0), result);
  return result;
}

}  // namespace

void repaint(MeshScene& scene, double share, std::mt19937_64& rng) {
  for (Material& material : scene.materials) {
    if (draw_uniform(rng) >= share || material.opacity < kClear) {
      continue;
    }
    if (!material.texture.empty()) {
      material.texture = tinted(material.texture, rng);
    } else if (draw_index(rng, 2) == 0) {
      material.colour = random_colour(rng);
    } else {
      material.texture = pattern(rng);
    }
  }
}

}  // namespace cmn
