// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/clearance_map.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Stamps are rows of these, and no wider than two.
using Bytes = std::uint8_t __attribute__((vector_size(16)));
constexpr int kWidth = sizeof(Bytes);
constexpr int kLargestRadius =
    kWidth - 1;  ///< [cells]; so large, distances have fewer than 255 ranks
constexpr std::uint8_t kFar = 255;

/// The steps of the chamfer distance in 1/65536 of a cell, as OpenCV has them.
constexpr std::uint32_t kStraight = 65536;
constexpr std::uint32_t kDiagonal = 91750;
constexpr std::uint32_t kKnight = 143976;

std::uint32_t chamfer(int dx, int dy) {
  const auto longer = static_cast<std::uint32_t>(std::max(std::abs(dx), std::abs(dy)));
  const auto shorter = static_cast<std::uint32_t>(std::min(std::abs(dx), std::abs(dy)));
  return 2 * shorter <= longer ? shorter * kKnight + (longer - 2 * shorter) * kStraight
                               : (longer - shorter) * kKnight + (2 * shorter - longer) * kDiagonal;
}

/// From the middle of a cell to the border, not the middle, of the occupied one.
float clearance(float distance_cells, double resolution) {
  return std::max(0.0F, distance_cells - 0.5F) * static_cast<float>(resolution);
}

float clearance_of(std::uint32_t distance, double resolution) {
  return clearance(static_cast<float>(distance) / static_cast<float>(kStraight), resolution);
}

void lower(std::uint8_t* values, const std::uint8_t* bounds) {
  Bytes a;
  Bytes b;
  std::memcpy(&a, values, sizeof a);
  std::memcpy(&b, bounds, sizeof b);
  a = a < b ? a : b;
  std::memcpy(values, &a, sizeof a);
}

}  // namespace

void ClearanceMap::measure(const LocalOccupancy& local, double most_m) {
  size_ = local.size;
  resolution_ = local.resolution;
  clearance_m_.resize(local.cell_count());
  find_rim(local);
  const double reach = most_m / resolution_ + 0.5;
  if (reach < kLargestRadius) {
    cut_stamp(most_m, static_cast<int>(reach));
    press_stamps();
  } else {
    transform(most_m);
  }
  for (std::size_t i = 0; i < clearance_m_.size(); ++i) {
    clearance_m_[i] = local.confidence[i] > 0.0F ? clearance_m_[i] : static_cast<float>(kUnseen);
  }
}

void ClearanceMap::find_rim(const LocalOccupancy& local) {
  const auto size = static_cast<std::size_t>(size_);
  const std::size_t stride = size + 2;
  is_occupied_.assign(stride * stride, 1);
  for (std::size_t y = 0; y < size; ++y) {
    const float* occupancy = local.occupancy.data() + y * size;
    const float* confidence = local.confidence.data() + y * size;
    std::uint8_t* row = is_occupied_.data() + (y + 1) * stride + 1;
    for (std::size_t x = 0; x < size; ++x) {
      row[x] = static_cast<std::uint8_t>((confidence[x] > 0.0F) & (occupancy[x] > 0.5F));
    }
  }
  // On the rim are those with a free cell among their eight neighbours.
  has_occupied_sides_.resize(stride * stride);
  is_rim_.resize(stride * stride);
  const std::uint8_t* occupied = is_occupied_.data();
  std::uint8_t* sides = has_occupied_sides_.data();
  for (std::size_t i = 1; i + 1 < stride * stride; ++i) {
    sides[i] = occupied[i - 1] & occupied[i] & occupied[i + 1];
  }
  std::uint8_t* rim = is_rim_.data();
  for (std::size_t i = stride; i < stride * (stride - 1); ++i) {
    rim[i] = static_cast<std::uint8_t>(occupied[i] &
                                       ~(sides[i - stride] & sides[i] & sides[i + stride]));
  }
}

void ClearanceMap::cut_stamp(double most_m, int radius) {
  if (stamp_.resolution == resolution_ && stamp_.most_m == most_m) {
    return;
  }
  stamp_ = {resolution_, most_m, radius, {}, {}};
  std::vector<std::uint32_t> distances;
  for (int dy = 0; dy <= radius; ++dy) {
    for (int dx = dy; dx <= radius; ++dx) {
      const std::uint32_t distance = chamfer(dx, dy);
      if (static_cast<double>(clearance_of(distance, resolution_)) <= most_m) {
        distances.push_back(distance);
      }
    }
  }
  std::sort(distances.begin(), distances.end());
  distances.erase(std::unique(distances.begin(), distances.end()), distances.end());
  const int width = 2 * radius + 1 <= kWidth ? kWidth : 2 * kWidth;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx < width - radius; ++dx) {
      const auto at = std::lower_bound(distances.begin(), distances.end(), chamfer(dx, dy));
      const bool is_near = dx <= radius && at != distances.end() && *at == chamfer(dx, dy);
      stamp_.ranks.push_back(is_near ? static_cast<std::uint8_t>(at - distances.begin()) : kFar);
    }
  }
  stamp_.clearance_m.assign(256, kInfinity);
  std::transform(distances.begin(), distances.end(), stamp_.clearance_m.begin(),
                 [&](std::uint32_t distance) { return clearance_of(distance, resolution_); });
}

void ClearanceMap::press_stamps() {
  const auto size = static_cast<std::size_t>(size_);
  const auto radius = static_cast<std::size_t>(stamp_.radius);
  const std::size_t rows = 2 * radius + 1;
  const std::size_t width = stamp_.ranks.size() / rows;
  const std::size_t stride = size + width;
  nearest_.assign(stride * (size + 2 * radius), kFar);
  for (std::size_t y = 0; y < size; ++y) {
    const std::uint8_t* occupied = is_occupied_.data() + (y + 1) * (size + 2) + 1;
    std::uint8_t* row = nearest_.data() + (y + radius) * stride + radius;
    for (std::size_t x = 0; x < size; ++x) {
      row[x] = occupied[x] != 0 ? 0 : kFar;
    }
  }
  // Of column x and row y the stamp begins there, `radius` columns and rows of the border before.
  const auto press = [&](std::size_t x, std::size_t y) {
    std::uint8_t* row = nearest_.data() + y * stride + x;
    const std::uint8_t* ranks = stamp_.ranks.data();
    for (std::size_t i = 0; i < rows; ++i, row += stride, ranks += width) {
      lower(row, ranks);
      if (width > kWidth) {
        lower(row + kWidth, ranks + kWidth);
      }
    }
  };
  for (std::size_t y = 0; y < size; ++y) {
    const std::uint8_t* rim = is_rim_.data() + (y + 1) * (size + 2) + 1;
    const std::uint8_t* end = rim + size;
    while (const void* at = std::memchr(rim, 1, static_cast<std::size_t>(end - rim))) {
      rim = static_cast<const std::uint8_t*>(at);
      press(size - static_cast<std::size_t>(end - rim), y);
      ++rim;
    }
  }
  for (std::size_t y = 0; y < size; ++y) {
    const std::uint8_t* ranks = nearest_.data() + (y + radius) * stride + radius;
    const float* clearance_m = stamp_.clearance_m.data();
    float* row = clearance_m_.data() + y * size;
    for (std::size_t x = 0; x < size; ++x) {
      row[x] = clearance_m[ranks[x]];
    }
  }
}

void ClearanceMap::transform(double most_m) {
  cv::Mat is_free(size_, size_, CV_8U);
  for (int y = 0; y < size_; ++y) {
    const std::uint8_t* row = is_occupied_.data() + (y + 1) * (size_ + 2) + 1;
    std::transform(row, row + size_, is_free.ptr<std::uint8_t>(y),
                   [](std::uint8_t occupied) { return occupied == 0 ? 255 : 0; });
  }
  cv::Mat distance(size_, size_, CV_32F, clearance_m_.data());
  cv::distanceTransform(is_free, distance, cv::DIST_L2, cv::DIST_MASK_5, CV_32F);
  for (float& cell : clearance_m_) {
    const float clear_m = clearance(cell, resolution_);
    cell = static_cast<double>(clear_m) <= most_m ? clear_m : kInfinity;
  }
}

}  // namespace cmn
