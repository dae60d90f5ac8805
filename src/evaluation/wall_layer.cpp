// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/drawing.hpp"
#include "coarse_map_nav/mapping/image_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

/// Joins pieces of a straight wall over gaps up to `gap_px`, along rows and along columns. Only
/// strokes count that are at least half a gap long and less than a third of that thick; a LiDAR may
/// have seen them as dashes, `dash_px` apart.
cv::Mat bridged(const cv::Mat& occupied, int gap_px, int dash_px) {
  cv::Mat joined = occupied.clone();
  const int stroke_px = std::max(3, gap_px / 2);
  for (const bool along_x : {true, false}) {
    const auto line = [&](int length) {
      return cv::getStructuringElement(cv::MORPH_RECT,
                                       along_x ? cv::Size{length, 1} : cv::Size{1, length});
    };
    const auto across = [&](int length) {
      return cv::getStructuringElement(cv::MORPH_RECT,
                                       along_x ? cv::Size{1, length} : cv::Size{length, 1});
    };
    cv::Mat strokes;
    cv::morphologyEx(occupied, strokes, cv::MORPH_CLOSE, line(dash_px + 1));
    cv::morphologyEx(strokes, strokes, cv::MORPH_OPEN, line(stroke_px));
    cv::Mat thick;
    cv::morphologyEx(strokes, thick, cv::MORPH_OPEN, across(std::max(3, stroke_px / 3 + 1)));
    strokes.setTo(0, thick);
    cv::Mat bridges;
    cv::morphologyEx(strokes, bridges, cv::MORPH_CLOSE, line(gap_px));
    joined |= bridges;
  }
  return joined;
}

}  // namespace

CoarseMap without_furniture(const CoarseMap& world, const WallParams& params) {
  const double res = world.resolution();
  // What lies outside the grid is occupied: a border of one cell ties the rim together.
  cv::Mat occupied;
  cv::copyMakeBorder(image_of(world.occupied()), occupied, 1, 1, 1, 1, cv::BORDER_CONSTANT,
                     cv::Scalar{255});
  const auto pixels = [&](double metres) { return static_cast<int>(std::lround(metres / res)); };
  const cv::Mat joined = bridged(occupied, pixels(params.gap_m), pixels(params.dash_m));
  cv::Mat island;
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(joined, island, stats, centroids, 8, CV_32S);
  std::vector<std::uint8_t> stays(static_cast<std::size_t>(count), 0);
  const double longest = params.longest_furniture_m / res;
  for (int i = 1; i < count; ++i) {
    stays[static_cast<std::size_t>(i)] = std::max(stats.at<int>(i, cv::CC_STAT_WIDTH),
                                                  stats.at<int>(i, cv::CC_STAT_HEIGHT)) > longest
                                             ? 255
                                             : 0;
  }
  stays[static_cast<std::size_t>(island.at<int>(0, 0))] = 255;
  cv::Mat walls(world.height(), world.width(), CV_8U);
  for (int y = 0; y < walls.rows; ++y) {
    for (int x = 0; x < walls.cols; ++x) {
      walls.at<std::uint8_t>(y, x) = occupied.at<std::uint8_t>(y + 1, x + 1) &
                                     stays[static_cast<std::size_t>(island.at<int>(y + 1, x + 1))];
    }
  }
  return {grid_of(walls), res, world.T_map_grid()};
}

}  // namespace cmn
