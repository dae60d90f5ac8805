// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/clearance_map.hpp"

#include <algorithm>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cmn {

void ClearanceMap::measure(const LocalOccupancy& local) {
  size_ = local.size;
  resolution_ = local.resolution;
  is_seen_.resize(local.cell_count());
  clearance_m_.resize(local.cell_count());
  cv::Mat is_free(size_, size_, CV_8U);
  for (std::size_t i = 0; i < local.cell_count(); ++i) {
    is_seen_[i] = static_cast<std::uint8_t>(local.confidence[i] > 0.0F);
    is_free.data[i] = is_seen_[i] != 0 && local.occupancy[i] > 0.5F ? 0 : 255;
  }
  cv::Mat distance(size_, size_, CV_32F, clearance_m_.data());
  cv::distanceTransform(is_free, distance, cv::DIST_L2, cv::DIST_MASK_5, CV_32F);
  // From the middle of a cell to the border, not the middle, of the occupied one.
  for (float& cell : clearance_m_) {
    cell = std::max(0.0F, cell - 0.5F) * static_cast<float>(resolution_);
  }
}

}  // namespace cmn
