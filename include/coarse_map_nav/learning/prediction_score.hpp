// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How well predicted occupancy agrees with the truth, over any number of panoramas.
#pragma once

#include "coarse_map_nav/data/local_occupancy.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include <opencv2/core.hpp>

namespace cmn {

/// Counts of two kinds of cells by a score in [0, 1], in bins of 1/1000.
class ScoreHistogram {
 public:
  void add(float score, bool is_positive);
  double count() const;
  /// Share of cells that are positive; NaN without cells. The average precision of a constant
  /// score.
  double positive_share() const;
  /// Area under the steps of precision over recall; cells of one bin count as tied. NaN without
  /// positives. CMP, table A1.
  double average_precision() const;
  /// Mean of |share of positives - mean score| over 15 equal bins, weighed by their cells (Guo et
  /// al. 2017). NaN without cells.
  double calibration_error() const;
  /// Positives with a score over 0.5, over all cells that are the one or the other; NaN without.
  double intersection_over_union() const;

 private:
  static constexpr std::size_t kBins = 1000;
  std::array<std::uint64_t, kBins + 1> positive_{};
  std::array<std::uint64_t, kBins + 1> negative_{};
};

/// The figures of one square, near or wide. Free space is the positive class.
struct SquareScore {
  ScoreHistogram seen;      ///< cells in sight, by P(free)
  ScoreHistogram all;       ///< every cell, by P(free) * P(in sight): beyond counts as occupied
  ScoreHistogram occupied;  ///< cells in sight, by P(occupied)
  ScoreHistogram in_sight;  ///< every cell, by P(in sight), which is the positive class

  /// `truth`: bits as Example has them, of the prediction's size.
  void add(const LocalOccupancy& predicted, const cv::Mat& truth);
};

/// "AP 0.912 IoU 0.881 ..." of a square on one line.
std::string score_text(const SquareScore& score);

}  // namespace cmn
