// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How the hypotheses of a ScaleFilter move.
#include "coarse_map_nav/localization/scale_filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace cmn {
namespace {

Cell rounded(Point2 p) {
  return {static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y))};
}

}  // namespace

void ScaleFilter::shift(WeightLayer& layer, Cell by) {
  const std::ptrdiff_t delta = static_cast<std::ptrdiff_t>(by.y) * parts_.stride() + by.x;
  const auto blocked = static_cast<float>(params_.blocked_share);
  scratch_.clear_like(layer);
  layer.for_each([&](std::uint32_t i, float weight) {
    const Cell to = parts_.part_of(i) + by;
    const bool may_go = to.x >= -1 && to.y >= -1 && to.x <= parts_.map().width() &&
                        to.y <= parts_.map().height() &&
                        model_->table.may_stand(static_cast<std::size_t>(i + delta));
    // Mass that faces a wall stays (CMN eq. 1), but hardly: walls that are drawn mostly stand.
    scratch_.add(static_cast<std::uint32_t>(may_go ? i + delta : i),
                 (may_go ? 1.0F : blocked) * weight);
  });
  std::swap(layer, scratch_);
}

void ScaleFilter::diffuse(WeightLayer& layer, double share) {
  const auto give = static_cast<float>(share);
  scratch_.clear_like(layer);
  layer.for_each([&](std::uint32_t i, float weight) {
    float stays = weight;
    const float part = give * weight;
    for (const std::ptrdiff_t step :
         {std::ptrdiff_t{1}, std::ptrdiff_t{-1}, std::ptrdiff_t{parts_.stride()},
          -std::ptrdiff_t{parts_.stride()}}) {
      const auto target = static_cast<std::uint32_t>(i + step);
      if (model_->table.may_stand(target)) {
        scratch_.add(target, part);
        stays -= part;
      }
    }
    scratch_.add(i, stays);
  });
  std::swap(layer, scratch_);
}

void ScaleFilter::move(Sheet& sheet, Point2 driven_m) {
  sheet.offset = sheet.offset + (sheet.scale / parts_.map().resolution()) * driven_m;
  const Cell whole = rounded(sheet.offset);
  sheet.offset = sheet.offset - Point2{static_cast<double>(whole.x), static_cast<double>(whole.y)};
  const double share =
      std::min(0.2, params_.diffusion * parts_.cuts() * parts_.cuts() * norm(driven_m));
  for (int layer = 0; layer < 4; ++layer) {
    if (whole != Cell{0, 0}) {
      shift(sheet.layers[static_cast<std::size_t>(layer)], turned(whole, layer));
    }
    if (share > 0.0) {
      diffuse(sheet.layers[static_cast<std::size_t>(layer)], share);
    }
  }
}

}  // namespace cmn
