// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/example.hpp"

#include "coarse_map_nav/perception/occupancy_predictor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

/// How far a row or column lies from the middle of the grid, to either side; counted from 0.
int from_middle(int i, int half) { return i >= half ? i - half : half - 1 - i; }

/// Whether the line from the middle to the middle of a cell meets an occupied cell before it. Goes
/// from column to column or from row to row, in the same way in all eight octants.
bool is_hidden(const cv::Mat& truth, int ix, int iy) {
  const int half = truth.cols / 2;
  const int ax = from_middle(ix, half);
  const int ay = from_middle(iy, half);
  const bool is_flat = ax >= ay;
  const int farther = std::max(ax, ay);
  const double slope = (std::min(ax, ay) + 0.5) / (farther + 0.5);
  for (int along = 0; along < farther; ++along) {
    const int across = static_cast<int>((along + 0.5) * slope);
    const int x = is_flat ? along : across;
    const int y = is_flat ? across : along;
    const std::uint8_t cell = truth.at<std::uint8_t>(iy >= half ? half + y : half - 1 - y,
                                                     ix >= half ? half + x : half - 1 - x);
    if ((cell & kTruthOccupied) != 0) {
      return true;
    }
  }
  return false;
}

/// The same along both axes, which OpenCV's ellipse is not.
cv::Mat disc(int radius) {
  cv::Mat kernel(2 * radius + 1, 2 * radius + 1, CV_8UC1);
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      kernel.at<std::uint8_t>(y + radius, x + radius) = x * x + y * y <= radius * radius ? 1 : 0;
    }
  }
  return kernel;
}

/// Clears kTruthSeen where all views that hold a cell are black; diagonals are in two.
void hide_black(cv::Mat& truth, const std::array<bool, kViewCount>& is_black) {
  for (int iy = 0; iy < truth.rows; ++iy) {
    for (int ix = 0; ix < truth.cols; ++ix) {
      const int x = 2 * ix + 1 - truth.cols;
      const int y = 2 * iy + 1 - truth.rows;
      const bool along = is_black[x > 0 ? 0 : 2];
      const bool across = is_black[y > 0 ? 1 : 3];
      const bool is_hidden = std::abs(x) == std::abs(y)  ? along && across
                             : std::abs(x) > std::abs(y) ? along
                                                         : across;
      if (is_hidden) {
        truth.at<std::uint8_t>(iy, ix) &= static_cast<std::uint8_t>(~kTruthSeen);
      }
    }
  }
}

/// The grid as a robot sees it that has turned left once: what was to the left is ahead.
cv::Mat turned_once(const cv::Mat& truth) {
  // new(iy, ix) = old cell whose offset is the new one's turned to the left: (-iy, ix).
  cv::Mat transposed;
  cv::transpose(truth, transposed);
  cv::Mat result;
  cv::flip(transposed, result, 0);
  return result;
}

}  // namespace

Example::Example()
    : near(kNearSize, kNearSize, CV_8UC1, cv::Scalar::all(0)),
      wide(kWideSize, kWideSize, CV_8UC1, cv::Scalar::all(0)) {}

void mark_seen(cv::Mat& truth, double side_m, double view_rad) {
  assert(truth.type() == CV_8UC1 && truth.rows == truth.cols && truth.rows % 2 == 0);
  const int half = truth.cols / 2;
  const double widest = std::tan(0.5 * view_rad);
  cv::Mat free_seen = cv::Mat::zeros(truth.size(), CV_8UC1);
  for (int iy = 0; iy < truth.rows; ++iy) {
    for (int ix = 0; ix < truth.cols; ++ix) {
      const auto [less, more] = std::minmax({from_middle(ix, half), from_middle(iy, half)});
      // 90 degrees take in the diagonals, whatever the tangent's last bit.
      const bool is_viewed = less + 0.5 <= (widest + 1e-9) * (more + 0.5);
      const bool is_seen = (truth.at<std::uint8_t>(iy, ix) & kTruthOccupied) == 0 && is_viewed &&
                           !is_hidden(truth, ix, iy);
      free_seen.at<std::uint8_t>(iy, ix) = is_seen ? 1 : 0;
    }
  }
  const int reach = std::max(1, cvRound(kSolid_m * truth.cols / side_m));
  cv::Mat near_seen;
  cv::dilate(free_seen, near_seen, disc(reach));
  for (int iy = 0; iy < truth.rows; ++iy) {
    for (int ix = 0; ix < truth.cols; ++ix) {
      std::uint8_t& cell = truth.at<std::uint8_t>(iy, ix);
      const bool is_occupied = (cell & kTruthOccupied) != 0;
      const cv::Mat& seen = is_occupied ? near_seen : free_seen;
      cell = static_cast<std::uint8_t>((is_occupied ? kTruthOccupied : 0) |
                                       (seen.at<std::uint8_t>(iy, ix) != 0 ? kTruthSeen : 0));
    }
  }
}

Example turned(const Example& example, int quarter_turns) {
  Example result = example;
  result.panorama = turned(example.panorama, quarter_turns);
  for (int i = 0; i < ((quarter_turns % 4) + 4) % 4; ++i) {
    result.near = turned_once(result.near);
    result.wide = turned_once(result.wide);
  }
  return result;
}

Example mirrored(const Example& example) {
  Example result = example;
  for (std::size_t k = 0; k < kViewCount; ++k) {
    cv::Mat view;
    cv::flip(example.panorama.views[(kViewCount - k) % kViewCount], view, 1);
    result.panorama.views[k] = view;
  }
  cv::flip(example.near, result.near, 0);
  cv::flip(example.wide, result.wide, 0);
  return result;
}

Example blacked_out(const Example& example, const std::array<bool, kViewCount>& is_black) {
  Example result = example;
  for (std::size_t k = 0; k < kViewCount; ++k) {
    if (is_black[k]) {
      result.panorama.views[k] = cv::Mat::zeros(kViewSide, kViewSide, CV_8UC3);
    }
  }
  result.near = example.near.clone();
  result.wide = example.wide.clone();
  hide_black(result.near, is_black);
  hide_black(result.wide, is_black);
  return result;
}

}  // namespace cmn
