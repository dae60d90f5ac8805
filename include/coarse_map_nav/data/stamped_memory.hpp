// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What was said lately, by the time that it was said of.
#pragma once

#include <cstddef>
#include <map>
#include <utility>

namespace cmn {

/// Pairs what reaches a node by different ways: a belief with what else was made of the same
/// observation. Holds the last kMost values.
template <class T>
class StampedMemory {
 public:
  void remember(double stamp_s, T value) {
    // What is of a later time was seen before time went back.
    values_.erase(values_.upper_bound(stamp_s), values_.end());
    values_[stamp_s] = std::move(value);
    if (values_.size() > kMost) {
      values_.erase(values_.begin());
    }
  }
  /// Of exactly this time; null when it is not remembered.
  const T* at(double stamp_s) const {
    const auto found = values_.find(stamp_s);
    return found == values_.end() ? nullptr : &found->second;
  }
  /// Of this time or, where that is not remembered, the next later one.
  const T* at_or_after(double stamp_s) const {
    const auto found = values_.lower_bound(stamp_s);
    return found == values_.end() ? nullptr : &found->second;
  }

  static constexpr std::size_t kMost = 30;  ///< 3 s of a LiDAR

 private:
  std::map<double, T> values_;
};

}  // namespace cmn
