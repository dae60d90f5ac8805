// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/weight_layer.hpp"

#include <algorithm>

namespace cmn {

double WeightLayer::sum() const {
  double sum = 0.0;
  for_each([&](std::uint32_t, float weight) { sum += static_cast<double>(weight); });
  return sum;
}

void WeightLayer::unlist() {
  is_listed_ = false;
  std::vector<std::uint32_t>{}.swap(list_);
}

void WeightLayer::clear_like(const WeightLayer& other) {
  if (is_listed_) {
    for (const std::uint32_t i : list_) {
      weights_[i] = 0.0F;
    }
    list_.clear();
  } else {
    std::fill(weights_.begin(), weights_.end(), 0.0F);
  }
  is_listed_ = other.is_listed_;
}

void WeightLayer::settle() {
  if (is_listed_) {
    list_.erase(std::remove_if(list_.begin(), list_.end(),
                               [&](std::uint32_t i) { return weights_[i] == 0.0F; }),
                list_.end());
    if (list_.size() > most_listed_) {
      unlist();
    }
    return;
  }
  const auto zeros = static_cast<std::size_t>(std::count(weights_.begin(), weights_.end(), 0.0F));
  if (weights_.size() - zeros <= most_listed_) {
    for_each([&](std::uint32_t i, float) { list_.push_back(i); });
    is_listed_ = true;
  }
}

}  // namespace cmn
