// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/ink.hpp"

#include <algorithm>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

cv::Mat disc(double diameter_px) {
  const int side = 2 * static_cast<int>(diameter_px / 2.0) + 1;
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side});
}

/// The patches of a mask; `stats` as cv::connectedComponentsWithStats, label 0 is the rest.
int label_patches(const cv::Mat& mask, int connectivity, cv::Mat& labels, cv::Mat& stats) {
  cv::Mat centroids;
  return cv::connectedComponentsWithStats(mask, labels, stats, centroids, connectivity, CV_32S);
}

/// The pixels whose label is chosen.
cv::Mat pixels_of(const cv::Mat& labels, const std::vector<std::uint8_t>& chosen) {
  cv::Mat mask(labels.rows, labels.cols, CV_8UC1);
  for (int row = 0; row < labels.rows; ++row) {
    const int* label = labels.ptr<int>(row);
    std::uint8_t* pixel = mask.ptr<std::uint8_t>(row);
    for (int column = 0; column < labels.cols; ++column) {
      pixel[column] = chosen[static_cast<std::size_t>(label[column])];
    }
  }
  return mask;
}

cv::Mat rim_of(cv::Size size) {
  cv::Mat rim = cv::Mat::zeros(size, CV_8UC1);
  cv::rectangle(rim, {0, 0}, {size.width - 1, size.height - 1}, 255, 1);
  return rim;
}

}  // namespace

bool is_binary(const cv::Mat& gray) {
  return cv::countNonZero((gray > 50) & (gray < 205)) < 0.02 * static_cast<double>(gray.total());
}

cv::Mat flatten_light(const cv::Mat& gray) {
  // Light varies slowly: a small picture does.
  constexpr int kSide = 256;
  const double scale = static_cast<double>(kSide) / std::max(gray.cols, gray.rows);
  cv::Mat small;
  cv::resize(gray, small, {}, scale, scale, cv::INTER_AREA);
  cv::Mat brightest;
  cv::dilate(small, brightest, cv::getStructuringElement(cv::MORPH_RECT, {kSide / 4, kSide / 4}));
  cv::Mat level;
  small.convertTo(level, CV_32F);
  cv::Mat paper;
  cv::Mat(small > 0.8 * brightest).convertTo(paper, CV_32F, 1.0 / 255.0);
  level = level.mul(paper);
  // Mean of the paper nearby; the wider the less paper there is.
  cv::Mat sum = cv::Mat::zeros(small.size(), CV_32F);
  cv::Mat weight = cv::Mat::zeros(small.size(), CV_32F);
  double share = 1.0;
  for (const double sigma : {4.0, 12.0, 36.0, 108.0}) {
    cv::Mat blurred_level;
    cv::Mat blurred_paper;
    cv::GaussianBlur(level, blurred_level, {}, sigma);
    cv::GaussianBlur(paper, blurred_paper, {}, sigma);
    sum += share * blurred_level;
    weight += share * blurred_paper;
    share *= 1e-2;
  }
  cv::Mat light;
  cv::divide(sum, cv::max(weight, 1e-6), light);
  cv::resize(light, light, gray.size(), 0, 0, cv::INTER_LINEAR);
  cv::Mat flat;
  cv::divide(gray, cv::max(light, 1.0), flat, 255.0, CV_8U);
  return flat;
}

cv::Mat find_sheet(const cv::Mat& flat) {
  cv::Mat labels;
  cv::Mat stats;
  const int count = label_patches(flat > 191, 8, labels, stats);
  int largest = 0;
  for (int label = 1; label < count; ++label) {
    if (largest == 0 ||
        stats.at<int>(label, cv::CC_STAT_AREA) > stats.at<int>(largest, cv::CC_STAT_AREA)) {
      largest = label;
    }
  }
  cv::Mat sheet = cv::Mat::zeros(flat.size(), CV_8UC1);
  if (largest > 0) {
    // Drawn walls often divide the paper: all patches of a tenth of the largest belong to it.
    std::vector<std::uint8_t> chosen(static_cast<std::size_t>(count), 0);
    for (int label = 1; label < count; ++label) {
      chosen[static_cast<std::size_t>(label)] =
          stats.at<int>(label, cv::CC_STAT_AREA) > 0.1 * stats.at<int>(largest, cv::CC_STAT_AREA);
    }
    std::vector<cv::Point> pixels;
    cv::findNonZero(pixels_of(labels, chosen), pixels);
    std::vector<cv::Point> hull;
    cv::convexHull(pixels, hull);
    cv::fillConvexPoly(sheet, hull, 255);
    // Not its edge, which casts a shadow; the picture's own rim is no edge.
    cv::erode(sheet, sheet, disc(0.01 * std::max(flat.cols, flat.rows)));
  }
  return sheet;
}

cv::Mat threshold_ink(const cv::Mat& flat, double share) {
  cv::Mat ink;
  const bool otsu = !(share > 0.0);
  cv::threshold(flat, ink, 255.0 * share, 255.0,
                cv::THRESH_BINARY_INV | (otsu ? cv::THRESH_OTSU : 0));
  return ink;
}

cv::Mat remove_specks(const cv::Mat& ink, double size_px) {
  cv::Mat labels;
  cv::Mat stats;
  const int count = label_patches(ink, 8, labels, stats);
  std::vector<std::uint8_t> chosen(static_cast<std::size_t>(count), 0);
  for (int label = 1; label < count; ++label) {
    const int side =
        std::max(stats.at<int>(label, cv::CC_STAT_WIDTH), stats.at<int>(label, cv::CC_STAT_HEIGHT));
    chosen[static_cast<std::size_t>(label)] = side < size_px ? 0 : 255;
  }
  return pixels_of(labels, chosen);
}

cv::Mat fill_hatching(const cv::Mat& ink, double diameter_px) {
  cv::Mat padded;  // the rim of the picture does not enclose
  cv::copyMakeBorder(ink, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 255);
  cv::Mat distance;
  cv::distanceTransform(255 - padded, distance, cv::DIST_L2, 3);
  distance = distance(cv::Rect{{1, 1}, ink.size()});
  cv::Mat labels;
  cv::Mat stats;
  const int count = label_patches(255 - ink, 4, labels, stats);
  std::vector<std::uint8_t> wide(static_cast<std::size_t>(count), 0);
  for (int row = 0; row < ink.rows; ++row) {
    for (int column = 0; column < ink.cols; ++column) {
      if (2.0F * distance.at<float>(row, column) > static_cast<float>(diameter_px)) {
        wide[static_cast<std::size_t>(labels.at<int>(row, column))] = 255;
      }
    }
  }
  wide[0] = 0;
  return 255 - pixels_of(labels, wide);
}

bool has_margin(const cv::Mat& ink) {
  const cv::Mat rim = rim_of(ink.size());
  return cv::countNonZero(ink & rim) < 0.1 * cv::countNonZero(rim);
}

cv::Rect find_drawing(const cv::Mat& ink, double gap_px) {
  if (!has_margin(ink)) {
    return {{0, 0}, ink.size()};
  }
  cv::Mat joined;
  cv::dilate(ink, joined, disc(gap_px));
  cv::Mat labels;
  cv::Mat stats;
  const int count = label_patches(joined, 8, labels, stats);
  cv::Mat largest;
  double largest_area = 0.0;
  for (int label = 1; label < count; ++label) {
    const double area = static_cast<double>(stats.at<int>(label, cv::CC_STAT_WIDTH)) *
                        stats.at<int>(label, cv::CC_STAT_HEIGHT);
    if (area > largest_area) {
      largest_area = area;
      largest = (labels == label) & ink;
    }
  }
  return largest.empty() ? cv::Rect{} : cv::boundingRect(largest);
}

cv::Mat find_outside(const cv::Mat& ink, double diameter_px) {
  cv::Mat outside = cv::Mat::zeros(ink.size(), CV_8UC1);
  if (!has_margin(ink)) {
    return outside;
  }
  const int pad = static_cast<int>(diameter_px) + 2;  // the disc comes from beyond the picture
  cv::Mat padded;
  cv::copyMakeBorder(ink, padded, pad, pad, pad, pad, cv::BORDER_CONSTANT, 0);
  cv::Mat blocked;  // to the middle of the disc
  cv::dilate(padded, blocked, disc(diameter_px));
  cv::Mat labels;
  cv::Mat stats;
  const int count = label_patches(255 - blocked, 4, labels, stats);
  std::vector<std::uint8_t> chosen(static_cast<std::size_t>(count), 0);
  chosen[static_cast<std::size_t>(labels.at<int>(0, 0))] = 255;
  cv::Mat reached;
  cv::dilate(pixels_of(labels, chosen), reached, disc(diameter_px));
  reached = reached(cv::Rect{{pad, pad}, ink.size()}) & (255 - ink);
  // Notches of the outline that are too narrow for the disc: small, and open to the outside.
  const int patches = label_patches(255 - (ink | reached), 4, labels, stats);
  cv::Mat beside;
  cv::dilate(reached, beside, disc(3.0));
  std::vector<int> area(static_cast<std::size_t>(std::max(patches, 1)), 0);
  std::vector<std::uint8_t> notch(area.size(), 0);
  int largest = 0;
  for (int label = 1; label < patches; ++label) {
    area[static_cast<std::size_t>(label)] = stats.at<int>(label, cv::CC_STAT_AREA);
    largest = std::max(largest, area[static_cast<std::size_t>(label)]);
  }
  for (int row = 0; row < ink.rows; ++row) {
    for (int column = 0; column < ink.cols; ++column) {
      const auto label = static_cast<std::size_t>(labels.at<int>(row, column));
      if (label > 0 && beside.at<std::uint8_t>(row, column) != 0 && area[label] < 0.1 * largest) {
        notch[label] = 255;
      }
    }
  }
  reached |= pixels_of(labels, notch);
  const int inside = cv::countNonZero(255 - (ink | reached));
  const int all = static_cast<int>(ink.total()) - cv::countNonZero(reached);
  if (inside > 0.2 * all) {
    outside = reached;
  }
  return outside;
}

}  // namespace cmn
