// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/range_looks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace cmn {
namespace {

constexpr std::size_t kCodes = 256;

}  // namespace

RangeLooks::RangeLooks(std::shared_ptr<const RangeModel> model, const ScaleFilterParams& params)
    : model_{std::move(model)},
      reach_m_{params.reach_m},
      per_ray_{params.range_weight / kBearings / params.independence_m},
      told_(kCodes * kCodes, 0.0F) {
  const LogRange& code = model_->code;
  const std::vector<float>& log_of_hit = model_->log_of_hit;
  const auto metres = [&](std::size_t q) {
    return code.offset_m * std::exp(code.step() * static_cast<double>(q));
  };
  constexpr std::size_t kNoError = kCodes - 1;  // in log_of_hit
  const double cell_m = model_->parts.cuts() * model_->parts.map().resolution();
  for (std::size_t near = 0; near < kCodes; ++near) {
    for (std::size_t far = near + 1; far < kCodes; ++far) {
      const double surely = (metres(far) - cell_m) / metres(near);
      if (surely > 1.0) {
        const auto error = static_cast<std::size_t>(std::lround(std::log(surely) / code.step()));
        // Either may be true.
        told_[kCodes * near + far] = told_[kCodes * far + near] =
            log_of_hit[kNoError] -
            0.5F * (log_of_hit[kNoError - error] + log_of_hit[kNoError + error]);
      }
    }
  }
}

std::vector<double> RangeLooks::apart(const std::vector<GridPose>& poses, double scale) const {
  const MapParts& parts = model_->parts;
  const std::uint8_t cap = model_->code.coded(reach_m_ * scale);
  std::vector<std::optional<std::array<std::uint8_t, kBearings>>> expected;
  for (const GridPose& pose : poses) {
    expected.emplace_back();
    const Point2 p = static_cast<double>(parts.cuts()) * pose.position_cells;
    const Cell part{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))};
    if (!parts.map().contains(part) || !model_->table.may_stand(parts.padded_index(part))) {
      continue;
    }
    const std::uint8_t* row = model_->table.row(parts.padded_index(part));
    const auto turn =
        static_cast<int>(std::lround(wrap_angle(pose.yaw_rad) / (2.0 * kPi) * kBearings));
    expected.back().emplace();
    for (int b = 0; b < kBearings; ++b) {
      (*expected.back())[static_cast<std::size_t>(b)] =
          std::min(cap, row[(b + turn + kBearings) % kBearings]);
    }
  }
  std::vector<double> nats;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    for (std::size_t j = i + 1; j < expected.size(); ++j) {
      double told = 0.0;
      for (std::size_t b = 0; expected[i] && expected[j] && b < kBearings; ++b) {
        told += static_cast<double>(told_[kCodes * (*expected[i])[b] + (*expected[j])[b]]);
      }
      nats.push_back(per_ray_ * told);
    }
  }
  return nats;
}

}  // namespace cmn
