// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tensors.hpp"

#include <algorithm>
#include <cassert>

namespace cmn {
namespace {

/// Copies a continuous or cut-out 8-bit image; returns the place behind it.
std::uint8_t* copy_image(const cv::Mat& image, std::uint8_t* to) {
  const auto row_bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
  for (int row = 0; row < image.rows; ++row) {
    const auto* from = image.ptr<std::uint8_t>(row);
    to = std::copy(from, from + row_bytes, to);
  }
  return to;
}

at::Tensor truth_tensor(const std::vector<Example>& examples, cv::Mat Example::*square) {
  const int size = (examples.front().*square).rows;
  const auto count = static_cast<std::int64_t>(examples.size());
  at::Tensor truth = at::empty({count, size, size}, at::kByte);
  auto* to = truth.data_ptr<std::uint8_t>();
  for (const Example& example : examples) {
    to = copy_image(example.*square, to);
  }
  return truth;
}

}  // namespace

at::Tensor panoramas_tensor(const std::vector<ColorPanorama>& panoramas) {
  const auto count = static_cast<std::int64_t>(panoramas.size());
  at::Tensor bytes = at::empty({count, 4, kViewSide, kViewSide, 3}, at::kByte);
  auto* to = bytes.data_ptr<std::uint8_t>();
  for (const ColorPanorama& panorama : panoramas) {
    for (const cv::Mat& view : panorama.views) {
      assert(view.type() == CV_8UC3 && view.rows == kViewSide && view.cols == kViewSide);
      to = copy_image(view, to);
    }
  }
  // OpenCV has blue first.
  return bytes.permute({0, 1, 4, 2, 3}).flip({2}).to(at::kFloat).div_(255.0);
}

at::Tensor near_tensor(const std::vector<Example>& examples) {
  return truth_tensor(examples, &Example::near);
}
at::Tensor wide_tensor(const std::vector<Example>& examples) {
  return truth_tensor(examples, &Example::wide);
}

LocalOccupancy local_occupancy(const at::Tensor& square, double side_m, double stamp_s) {
  const at::Tensor plain = square.contiguous();
  const auto size = static_cast<int>(plain.size(1));
  LocalOccupancy result{size, side_m / size};
  result.stamp_s = stamp_s;
  result.source = ObservationSource::kRgb;
  const auto* from = plain.data_ptr<float>();
  const auto cells = static_cast<std::ptrdiff_t>(result.cell_count());
  std::copy(from, from + cells, result.occupancy.begin());
  std::copy(from + cells, from + 2 * cells, result.confidence.begin());
  return result;
}

}  // namespace cmn
