// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How the hypotheses of a ScaleFilter are weighed.
#include "coarse_map_nav/localization/scale_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

namespace cmn {
namespace {

/// Of the greatest weight; less is dropped, and with it the work on it.
constexpr float kLeastShare = 1e-9F;
/// Free rays are probed at these shares of their range.
constexpr std::array<double, 3> kProbes{0.3, 0.6, 0.85};

/// Four neighbouring cells: the width of the vectors that every 64 bit processor has.
using Four = float __attribute__((vector_size(16)));

Four sum_of(const float* values, const std::vector<std::ptrdiff_t>& offsets) {
  Four sum{};
  for (const std::ptrdiff_t offset : offsets) {
    Four four;
    std::memcpy(&four, values + offset, sizeof four);
    sum += four;
  }
  return sum;
}

Cell rounded(Point2 p) {
  return {static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y))};
}

}  // namespace

ScaleFilter::Evidence ScaleFilter::evidence(const RayProfile& rays, const Sheet& sheet,
                                            int layer) const {
  Evidence evidence;
  int known = 0;
  for (const Ray& ray : rays) {
    known += ray.is_known();
  }
  const auto range_weight = static_cast<float>(known > 0 ? params_.range_weight / known : 0.0);
  const int cap = model_->code.coded(params_.reach_m * sheet.scale);
  for (int b = 0; b < kBearings; ++b) {
    const Ray& ray = rays[static_cast<std::size_t>(b)];
    auto& by_code = evidence.by_code[static_cast<std::size_t>(b)];
    if (!ray.is_known()) {
      by_code.fill(0.0F);
      continue;
    }
    const int seen = model_->code.coded(ray.range_m * sheet.scale);
    const std::vector<float>& of_error = ray.is_hit ? model_->log_of_hit : model_->log_of_free;
    for (int q = 0; q < 256; ++q) {
      by_code[static_cast<std::size_t>(q)] =
          range_weight * of_error[static_cast<std::size_t>(seen - std::min(q, cap) + 255)];
    }
    const Point2 ahead = turned(Point2{1.0, 0.0}, bearing_rad(b));
    const auto offset_at = [&](double range_m) {
      return field_.offset_of(turned(
          rounded(sheet.offset + (range_m * sheet.scale / parts_.map().resolution()) * ahead),
          layer));
    };
    if (ray.is_hit) {
      evidence.hits.push_back(offset_at(ray.range_m));
    }
    if (b % 2 == 0) {
      for (const double share : kProbes) {
        evidence.frees.push_back(offset_at(share * ray.range_m));
      }
    }
  }
  return evidence;
}

double ScaleFilter::range_log_likelihood(const Evidence& evidence, int layer,
                                         std::uint32_t part) const {
  const std::uint8_t* expected = model_->table.row(part);
  // The look's bearing b lies at b + layer quarter turns on the drawing.
  float range = 0.0F;
  const int first = layer * kBearingsPerQuarter;
  for (int b = 0; b < kBearings - first; ++b) {
    range += evidence.by_code[static_cast<std::size_t>(b)][expected[b + first]];
  }
  for (int b = kBearings - first; b < kBearings; ++b) {
    range += evidence.by_code[static_cast<std::size_t>(b)][expected[b + first - kBearings]];
  }
  return static_cast<double>(range);
}

double ScaleFilter::together(const Evidence& evidence, float range, float hits, float frees,
                             bool is_free) const {
  const double fit = static_cast<double>(range) +
                     params_.field_weight * static_cast<double>(hits) /
                         std::max<double>(1.0, static_cast<double>(evidence.hits.size())) -
                     params_.free_weight * static_cast<double>(frees) /
                         std::max<double>(1.0, static_cast<double>(evidence.frees.size()));
  return fit + (is_free ? 0.0 : log_of_rim_);
}

double ScaleFilter::log_likelihood(const Evidence& evidence, int layer, std::uint32_t part) const {
  const std::ptrdiff_t at = field_.index_of(parts_.part_of(part));
  float hits = 0.0F;
  for (const std::ptrdiff_t offset : evidence.hits) {
    hits += field_.log_hit(at + offset);
  }
  float frees = 0.0F;
  for (const std::ptrdiff_t offset : evidence.frees) {
    frees += field_.occupied(at + offset);
  }
  return together(evidence, static_cast<float>(range_log_likelihood(evidence, layer, part)), hits,
                  frees, parts_.map().is_free(parts_.part_of(part)));
}

template <class Tell>
void ScaleFilter::measure_rows(const Evidence& evidence, int layer, const WeightLayer& weights,
                               Tell&& tell) const {
  std::vector<double> row(static_cast<std::size_t>(parts_.map().width()));
  const auto first = static_cast<std::size_t>(layer * kBearingsPerQuarter);
  for (int y = 0; y < parts_.map().height(); ++y) {
    for (int x = 0; x < parts_.map().width(); x += 4) {
      const std::size_t i = parts_.padded_index({x, y});
      // All four are looked up, and where one holds nothing another takes its place.
      std::array<const std::uint8_t*, 4> expected{};
      const std::uint8_t* any = nullptr;
      const auto here = static_cast<std::size_t>(std::min(4, parts_.map().width() - x));
      for (std::size_t k = 0; k < here; ++k) {
        expected[k] = weights[i + k] != 0.0F ? model_->table.row(i + k) : nullptr;
        any = expected[k] != nullptr ? expected[k] : any;
      }
      if (any == nullptr) {
        continue;
      }
      for (const std::uint8_t*& row : expected) {
        row = row != nullptr ? row : any;
      }
      const std::ptrdiff_t at = field_.index_of({x, y});
      const Four hits = sum_of(field_.log_hits_from(at), evidence.hits);
      const Four frees = sum_of(field_.occupied_from(at), evidence.frees);
      std::array<float, 4> range{};
      for (std::size_t b = 0; b < kBearings; ++b) {
        const std::size_t on_map = b + first < kBearings ? b + first : b + first - kBearings;
        const std::array<float, 256>& by_code = evidence.by_code[b];
        for (std::size_t k = 0; k < 4; ++k) {
          range[k] += by_code[expected[k][on_map]];
        }
      }
      for (std::size_t k = 0; k < here; ++k) {
        row[static_cast<std::size_t>(x) + k] =
            together(evidence, range[k], hits[k], frees[k],
                     parts_.map().is_free({x + static_cast<int>(k), y}));
      }
    }
    // Apart from the sums, which would wait for the logarithms of those who are told.
    for (int x = 0; x < parts_.map().width(); ++x) {
      const auto i = static_cast<std::uint32_t>(parts_.padded_index({x, y}));
      if (weights[i] != 0.0F) {
        tell(i, row[static_cast<std::size_t>(x)]);
      }
    }
  }
}

bool ScaleFilter::weigh(const LocalOccupancy& seen, double yaw_rad, double news) {
  std::vector<RayProfile> rays;  // in the axes of each turn
  for (int j = 0; j < turns(); ++j) {
    rays.push_back(cast_rays(seen, yaw_rad + turn_of(j), params_.reach_m));
  }
  // Logs first, in place of the weights: only their differences matter, so the greatest becomes 1.
  double greatest = -std::numeric_limits<double>::infinity();
  double fit = 0.0;
  for (std::size_t s = 0; s < sheets_.size(); ++s) {
    for (int layer = 0; layer < 4; ++layer) {
      WeightLayer& weights = sheets_[s].layers[static_cast<std::size_t>(layer)];
      if (weights.is_listed()) {
        weights.settle();  // moving may have made many of few
      }
      if (weights.is_listed() && weights.list().empty()) {
        continue;
      }
      const Evidence look =
          evidence(rays[s % static_cast<std::size_t>(turns())], sheets_[s], layer);
      const auto log_weight = [&](std::uint32_t i, double likelihood, float weight) {
        const double value = news * likelihood + std::log(static_cast<double>(weight));
        if (value > greatest) {
          greatest = value;
          fit = range_log_likelihood(look, layer, i) / std::max(1e-9, params_.range_weight);
        }
        // 0 would be no weight.
        return value == 0.0 ? -std::numeric_limits<float>::min() : static_cast<float>(value);
      };
      if (weights.is_listed()) {
        weights.for_each([&](std::uint32_t i, float& weight) {
          weight = log_weight(i, log_likelihood(look, layer, i), weight);
        });
      } else {
        measure_rows(look, layer, weights, [&](std::uint32_t i, double likelihood) {
          weights.set(i, log_weight(i, likelihood, weights[i]));
        });
      }
    }
  }
  if (!std::isfinite(greatest)) {
    return false;
  }
  double total = 0.0;
  for (Sheet& sheet : sheets_) {
    for (WeightLayer& weights : sheet.layers) {
      weights.for_each([&](std::uint32_t, float& weight) {
        const float w = std::exp(weight - static_cast<float>(greatest));
        weight = w > kLeastShare ? w : 0.0F;
        total += static_cast<double>(weight);
      });
      weights.settle();
    }
  }
  normalise(total);
  fit_ = has_fit_ ? fit_ + std::min(1.0, news * params_.independence_m / params_.reopen_way_m) *
                               (fit - fit_)
                  : fit;
  has_fit_ = true;
  return true;
}

}  // namespace cmn
