// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One weight a cell, most of them 0 most of the time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cmn {

/// An array of weights that lists the cells whose weight is not 0 while they are few: then work
/// follows their number. While they are many the array is gone through as it lies, and a list of
/// them would only take memory.
class WeightLayer {
 public:
  WeightLayer() = default;
  /// All 0. More than `most_listed` are many.
  WeightLayer(std::size_t cells, std::size_t most_listed)
      : weights_(cells, 0.0F), most_listed_{most_listed} {}

  float operator[](std::size_t i) const { return weights_[i]; }
  bool is_listed() const { return is_listed_; }
  /// Listed, in no order.
  const std::vector<std::uint32_t>& list() const { return list_; }

  double sum() const;

  void add(std::uint32_t i, float more) {
    float& weight = weights_[i];
    if (is_listed_ && weight == 0.0F && more != 0.0F) {
      list_.push_back(i);
    }
    weight += more;
  }
  /// Of a cell whose weight is not 0, to another such.
  void set(std::size_t i, float weight) { weights_[i] = weight; }
  /// visit(i, weight) for all cells whose weight is not 0. It may change the weight; settle() comes
  /// after that, when it has set any to 0.
  template <class Visit>
  void for_each(Visit&& visit) {
    each(*this, visit);
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    each(*this, visit);
  }
  /// All 0, and whether they are listed as in `other`.
  void clear_like(const WeightLayer& other);
  /// Lists them if they are few, and does not if they are many.
  void settle();
  /// Until the next settle().
  void unlist();

 private:
  template <class Self, class Visit>
  static void each(Self& self, Visit&& visit) {
    if (self.is_listed_) {
      for (const std::uint32_t i : self.list_) {
        visit(i, self.weights_[i]);
      }
      return;
    }
    for (std::size_t i = 0; i < self.weights_.size(); ++i) {
      if (self.weights_[i] != 0.0F) {
        visit(static_cast<std::uint32_t>(i), self.weights_[i]);
      }
    }
  }

  std::vector<float> weights_;
  std::vector<std::uint32_t> list_;
  std::size_t most_listed_ = 0;
  bool is_listed_ = true;
};

}  // namespace cmn
