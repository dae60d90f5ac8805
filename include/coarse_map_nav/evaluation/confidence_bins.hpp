// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How sure a belief said to be, and how often rightly, over the looks of an episode.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace cmn {

/// Looks by the confidence that was stated. Finer towards 1, where decisions are made.
class ConfidenceBins {
 public:
  struct Bin {
    int looks = 0;
    int right = 0;        ///< of them: the estimate was within 1 m, at the right quarter turn
    double stated = 0.0;  ///< sum of the confidences
  };
  static constexpr std::size_t kCount = 13;
  /// Bin i holds confidences from kEdges[i] up to, but for the last, below kEdges[i + 1].
  static constexpr std::array<double, kCount + 1> kEdges{0.0, 0.1, 0.2, 0.3,  0.4,  0.5,   0.6,
                                                         0.7, 0.8, 0.9, 0.95, 0.99, 0.999, 1.0};

  void add(double confidence, bool is_right);
  void add(const ConfidenceBins& other);

  const std::array<Bin, kCount>& bins() const { return bins_; }
  int looks() const;

  /// "0:4:0:0.213 12:80:80:79.988": bin, looks, right, stated of those that are not empty. A dash
  /// where all are.
  std::string text() const;
  /// Throws std::invalid_argument when it is none of text().
  static ConfidenceBins parse(const std::string& text);

 private:
  std::array<Bin, kCount> bins_{};
};

}  // namespace cmn
