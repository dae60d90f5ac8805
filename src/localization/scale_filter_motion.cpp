// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How the hypotheses of a ScaleFilter move.
#include "coarse_map_nav/localization/scale_filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace cmn {
namespace {

Cell rounded(Point2 p) {
  return {static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y))};
}

}  // namespace

void ScaleFilter::shift(Sheet& sheet, int layer, Cell by) {
  std::vector<float>& weight = sheet.weight[static_cast<std::size_t>(layer)];
  std::vector<std::uint32_t>& support = sheet.support[static_cast<std::size_t>(layer)];
  scratch_support_.clear();
  const std::ptrdiff_t delta = static_cast<std::ptrdiff_t>(by.y) * stride_ + by.x;
  const auto blocked = static_cast<float>(params_.blocked_share);
  for (const std::uint32_t i : support) {
    const Cell to = cell_of(i) + by;
    const bool may_go = to.x >= -1 && to.y >= -1 && to.x <= map_.width() && to.y <= map_.height() &&
                        table_.may_stand(static_cast<std::size_t>(i + delta));
    // Mass that faces a wall stays (CMN eq. 1), but hardly: walls that are drawn mostly stand.
    const auto target = static_cast<std::uint32_t>(may_go ? i + delta : i);
    const float mass = (may_go ? 1.0F : blocked) * weight[i];
    if (mass > 0.0F && scratch_[target] == 0.0F) {
      scratch_support_.push_back(target);
    }
    scratch_[target] += mass;
  }
  for (const std::uint32_t i : support) {
    weight[i] = 0.0F;
  }
  for (const std::uint32_t i : scratch_support_) {
    weight[i] = scratch_[i];
    scratch_[i] = 0.0F;
  }
  support.swap(scratch_support_);
}

void ScaleFilter::diffuse(Sheet& sheet, int layer, double share) {
  std::vector<float>& weight = sheet.weight[static_cast<std::size_t>(layer)];
  std::vector<std::uint32_t>& support = sheet.support[static_cast<std::size_t>(layer)];
  scratch_support_.clear();
  const auto give = static_cast<float>(share);
  for (const std::uint32_t i : support) {
    float stays = weight[i];
    const float part = give * weight[i];
    for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, std::ptrdiff_t{-1},
                                      std::ptrdiff_t{stride_}, -std::ptrdiff_t{stride_}}) {
      const auto target = static_cast<std::uint32_t>(i + step);
      if (table_.may_stand(target)) {
        if (scratch_[target] == 0.0F) {
          scratch_support_.push_back(target);
        }
        scratch_[target] += part;
        stays -= part;
      }
    }
    if (scratch_[i] == 0.0F) {
      scratch_support_.push_back(i);
    }
    scratch_[i] += stays;
  }
  for (const std::uint32_t i : scratch_support_) {
    weight[i] = scratch_[i];
    scratch_[i] = 0.0F;
  }
  support.swap(scratch_support_);
}

void ScaleFilter::move(Sheet& sheet, Point2 driven_m) {
  sheet.offset = sheet.offset + (sheet.scale / map_.resolution()) * driven_m;
  const Cell whole = rounded(sheet.offset);
  sheet.offset = sheet.offset - Point2{static_cast<double>(whole.x), static_cast<double>(whole.y)};
  const double share = std::min(0.2, params_.diffusion * norm(driven_m));
  for (int layer = 0; layer < 4; ++layer) {
    if (whole != Cell{0, 0}) {
      shift(sheet, layer, turned(whole, layer));
    }
    if (share > 0.0) {
      diffuse(sheet, layer, share);
    }
  }
}

void ScaleFilter::drift_between_scales(double share) {
  if (share <= 0.0 || sheets_.size() < 2) {
    return;
  }
  for (std::size_t layer = 0; layer < 4; ++layer) {
    const auto give = static_cast<float>(share);
    // From each sheet to the next and back: what both give up is exchanged at once.
    for (std::size_t s = 0; s + 1 < sheets_.size(); ++s) {
      Sheet& a = sheets_[s];
      Sheet& b = sheets_[s + 1];
      const std::size_t in_a = a.support[layer].size();
      for (const std::uint32_t i : b.support[layer]) {
        if (a.weight[layer][i] == 0.0F) {
          a.weight[layer][i] = std::numeric_limits<float>::min();
          a.support[layer].push_back(i);
        }
      }
      for (std::size_t j = 0; j < in_a; ++j) {
        const std::uint32_t i = a.support[layer][j];
        if (b.weight[layer][i] == 0.0F) {
          b.weight[layer][i] = std::numeric_limits<float>::min();
          b.support[layer].push_back(i);
        }
      }
      for (const std::uint32_t i : a.support[layer]) {
        const float from_a = give * a.weight[layer][i];
        const float from_b = give * b.weight[layer][i];
        a.weight[layer][i] += from_b - from_a;
        b.weight[layer][i] += from_a - from_b;
      }
    }
  }
}

}  // namespace cmn
