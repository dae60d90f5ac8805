// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/prediction_score.hpp"

#include "coarse_map_nav/learning/example.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <limits>

namespace cmn {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void ScoreHistogram::add(float score, bool is_positive) {
  const float place = std::clamp(score, 0.0F, 1.0F) * static_cast<float>(kBins);
  const auto bin = static_cast<std::size_t>(std::lround(place));
  ++(is_positive ? positive_ : negative_)[bin];
}

double ScoreHistogram::count() const {
  double sum = 0.0;
  for (std::size_t i = 0; i <= kBins; ++i) {
    sum += static_cast<double>(positive_[i] + negative_[i]);
  }
  return sum;
}

double ScoreHistogram::positive_share() const {
  double positives = 0.0;
  for (const std::uint64_t n : positive_) {
    positives += static_cast<double>(n);
  }
  const double cells = count();
  return cells > 0.0 ? positives / cells : kNaN;
}

double ScoreHistogram::average_precision() const {
  const double positives = positive_share() * count();
  if (!(positives > 0.0)) {
    return kNaN;
  }
  double area = 0.0;
  double true_positives = 0.0;
  double claimed = 0.0;
  for (std::size_t i = kBins + 1; i-- > 0;) {
    true_positives += static_cast<double>(positive_[i]);
    claimed += static_cast<double>(positive_[i] + negative_[i]);
    if (positive_[i] > 0) {
      area += static_cast<double>(positive_[i]) / positives * (true_positives / claimed);
    }
  }
  return area;
}

double ScoreHistogram::calibration_error() const {
  constexpr std::size_t kGroups = 15;
  const double cells = count();
  if (!(cells > 0.0)) {
    return kNaN;
  }
  double error = 0.0;
  for (std::size_t group = 0; group < kGroups; ++group) {
    double stated = 0.0;
    double positives = 0.0;
    for (std::size_t i = 0; i <= kBins; ++i) {
      if (std::min(i * kGroups / kBins, kGroups - 1) == group) {
        stated += static_cast<double>(i) / kBins * static_cast<double>(positive_[i] + negative_[i]);
        positives += static_cast<double>(positive_[i]);
      }
    }
    error += std::abs(positives - stated) / cells;
  }
  return error;
}

double ScoreHistogram::intersection_over_union() const {
  double both = 0.0;
  double either = 0.0;
  for (std::size_t i = 0; i <= kBins; ++i) {
    const bool is_claimed = 2 * i > kBins;
    both += is_claimed ? static_cast<double>(positive_[i]) : 0.0;
    either += static_cast<double>(positive_[i] + (is_claimed ? negative_[i] : 0));
  }
  return either > 0.0 ? both / either : kNaN;
}

void SquareScore::add(const LocalOccupancy& predicted, const cv::Mat& truth) {
  assert(truth.type() == CV_8UC1 && truth.rows == predicted.size && truth.cols == predicted.size);
  for (int iy = 0; iy < predicted.size; ++iy) {
    for (int ix = 0; ix < predicted.size; ++ix) {
      const std::size_t i = predicted.index_of(ix, iy);
      const float p_free = 1.0F - predicted.occupancy[i];
      const std::uint8_t cell = truth.at<std::uint8_t>(iy, ix);
      const bool is_free = (cell & kTruthOccupied) == 0;
      const bool is_seen = (cell & kTruthSeen) != 0;
      if (is_seen) {
        seen.add(p_free, is_free);
        occupied.add(predicted.occupancy[i], !is_free);
      }
      all.add(p_free * predicted.confidence[i], is_free);
      in_sight.add(predicted.confidence[i], is_seen);
    }
  }
}

std::string score_text(const SquareScore& score) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(),
                "AP_free=%.4f IoU_free=%.4f IoU_occupied=%.4f ECE=%.4f AP_free_all=%.4f "
                "AP_in_sight=%.4f ECE_in_sight=%.4f AP_always_free=%.4f AP_always_free_all=%.4f",
                score.seen.average_precision(), score.seen.intersection_over_union(),
                score.occupied.intersection_over_union(), score.seen.calibration_error(),
                score.all.average_precision(), score.in_sight.average_precision(),
                score.in_sight.calibration_error(), score.seen.positive_share(),
                score.all.positive_share());
  return text.data();
}

}  // namespace cmn
