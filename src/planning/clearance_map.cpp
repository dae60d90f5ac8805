// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/clearance_map.hpp"

#include <algorithm>
#include <cmath>

namespace cmn {
namespace {

// Steps of the mask, in multiples of 2^-16 so that sums of floats are exact (below 256 cells).
constexpr float kStraight = 1.0F;
constexpr float kDiagonal = 91750.0F / 65536.0F;  // 1.4
constexpr float kKnight = 143976.0F / 65536.0F;   // 2.1969
constexpr float kFar = 8192.0F;

/// What the two rows before let a row's cells be at the most, their own values being bounds as
/// well. Pointers are to the first cell; `out` is another row.
void pass_on(const float* row, const float* before, const float* two_before, int count,
             float* out) {
  for (int i = 0; i < count; ++i) {
    float least = row[i];
    least = std::min(least, before[i] + kStraight);
    least = std::min(least, std::min(before[i - 1], before[i + 1]) + kDiagonal);
    least = std::min(least, std::min(before[i - 2], before[i + 2]) + kKnight);
    least = std::min(least, std::min(two_before[i - 1], two_before[i + 1]) + kKnight);
    out[i] = least;
  }
}

/// Likewise, of the cell that lies `by` cells before.
void pass_along(const float* row, int by, float way, int count, float* out) {
  for (int i = 0; i < count; ++i) {
    out[i] = std::min(row[i], row[i - by] + way);
  }
}

}  // namespace

void ClearanceMap::measure(const LocalOccupancy& local, double farthest_m) {
  size_ = local.size;
  resolution_ = local.resolution;
  is_seen_.resize(local.cell_count());
  clearance_m_.resize(local.cell_count());
  const double farthest = std::min(std::ceil(farthest_m / resolution_) + 1.0, double(size_));
  int runs = 1;
  for (; (1 << runs) <= farthest; ++runs) {
  }
  border_ = std::max(2, 1 << (runs - 1));
  const auto stride = static_cast<std::size_t>(size_ + 2 * border_);
  cells_.assign(stride * static_cast<std::size_t>(size_ + 4), kFar);
  row_.assign(stride, kFar);
  other_row_.assign(stride, kFar);
  for (int y = 0; y < size_; ++y) {
    const std::size_t from = local.index_of(0, y);
    float* cells = row_of(y);
    for (int x = 0; x < size_; ++x) {
      const std::size_t i = from + static_cast<std::size_t>(x);
      is_seen_[i] = static_cast<std::uint8_t>(local.confidence[i] > 0.0F);
      cells[x] = local.confidence[i] > 0.0F && local.occupancy[i] > 0.5F ? 0.0F : kFar;
    }
  }
  sweep(1, runs);
  sweep(-1, runs);
  // From the middle of a cell to the border, not the middle, of the occupied one.
  for (int y = 0; y < size_; ++y) {
    const float* cells = row_of(y);
    float* clearance_m = clearance_m_.data() + local.index_of(0, y);
    for (int x = 0; x < size_; ++x) {
      clearance_m[x] = std::max(0.0F, cells[x] - 0.5F) * static_cast<float>(resolution_);
    }
  }
}

void ClearanceMap::sweep(int sense, int runs) {
  for (int i = 0; i < size_; ++i) {
    const int y = sense > 0 ? i : size_ - 1 - i;
    float* row = row_of(y);
    float* now = row_.data() + border_;
    float* next = other_row_.data() + border_;
    pass_on(row, row_of(y - sense), row_of(y - 2 * sense), size_, now);
    // Runs of 1, 2, 4 ... cells: together any up to 2^runs - 1.
    for (int run = 0; run < runs; ++run) {
      const int cells = 1 << run;
      pass_along(now, sense * cells, static_cast<float>(cells) * kStraight, size_,
                 run + 1 == runs ? row : next);
      std::swap(now, next);
    }
  }
}

}  // namespace cmn
