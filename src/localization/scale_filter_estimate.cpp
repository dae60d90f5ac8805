// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a ScaleFilter says of its hypotheses.
#include "coarse_map_nav/localization/scale_filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cmn {

std::vector<double> ScaleFilter::scale_marginal() const {
  std::vector<double> marginal(static_cast<std::size_t>(params_.scales), 0.0);
  for (std::size_t s = 0; s < sheets_.size(); ++s) {
    for (const WeightLayer& weights : sheets_[s].layers) {
      marginal[s / static_cast<std::size_t>(turns())] += weights.sum();
    }
  }
  return marginal;
}

std::vector<double> ScaleFilter::turn_marginal() const {
  std::vector<double> marginal(static_cast<std::size_t>(turns()), 0.0);
  for (std::size_t s = 0; s < sheets_.size(); ++s) {
    for (const WeightLayer& weights : sheets_[s].layers) {
      marginal[s % static_cast<std::size_t>(turns())] += weights.sum();
    }
  }
  return marginal;
}

void ScaleFilter::forget_shown() {
  if (is_shown_listed_) {
    for (const auto& [heading, i] : shown_) {
      belief_.layer(heading)[i] = 0.0;
    }
  } else {
    for (const Heading heading : kHeadings) {
      std::fill(belief_.layer(heading).begin(), belief_.layer(heading).end(), 0.0);
    }
  }
  shown_.clear();
  is_shown_listed_ = true;
}

void ScaleFilter::list_shown(Heading heading, std::size_t i) {
  if (is_shown_listed_) {
    shown_.emplace_back(heading, static_cast<std::uint32_t>(i));
    if (shown_.size() > map_.occupied().size() / 8) {
      is_shown_listed_ = false;
      decltype(shown_){}.swap(shown_);
    }
  }
}

void ScaleFilter::summarise() {
  forget_shown();
  belief_.set_factor(1.0);
  double best = -1.0;
  Heading best_heading = Heading::kEast;
  std::uint32_t best_part = 0;
  for (int layer = 0; layer < 4; ++layer) {
    for (const Sheet& sheet : sheets_) {
      const Heading heading = heading_of(sheet, layer);
      std::vector<double>& shown = belief_.layer(heading);
      sheet.layers[static_cast<std::size_t>(layer)].for_each([&](std::uint32_t i, float weight) {
        const std::size_t at =
            parts_.cuts() == 1 ? i : belief_.padded_index(parts_.cell_of(parts_.part_of(i)));
        if (shown[at] == 0.0) {
          list_shown(heading, at);
        }
        shown[at] += static_cast<double>(weight);
        if (shown[at] > best) {
          best = shown[at];
          best_heading = heading;
          best_part = i;
        }
      });
    }
  }
  estimate_ = {best_heading, parts_.cell_of(parts_.part_of(best_part)), best};

  // Which way the robot faces there, finer than a heading.
  const std::vector<Cell> parts_here = parts_.parts_in(estimate_.cell);
  float most = -1.0F;
  double facing_rad = 0.0;
  for (int layer = 0; layer < 4; ++layer) {
    for (const Sheet& sheet : sheets_) {
      float weight = 0.0F;
      for (const Cell part : parts_here) {
        weight += sheet.layers[static_cast<std::size_t>(layer)][parts_.padded_index(part)];
      }
      if (weight > most && heading_of(sheet, layer) == best_heading) {
        most = weight;
        const double beyond_rad = yaw_rad_ + sheet.turn_rad;
        facing_rad =
            yaw(best_heading) + wrap_angle(beyond_rad - nearest_quarter(beyond_rad) * kPi / 2.0);
      }
    }
  }
  // The mean of what lies within 1 m of the best cell and faces about the same way: finer than a
  // cell, and the scale there. By direction, not by heading: a robot that faces a diagonal is in
  // one place yet.
  const std::vector<Cell> near = parts_.parts_near(estimate_.cell, 1.0);
  constexpr double kSameWay_rad = kPi / 4.0 - 1e-6;
  Point2 sum;
  double mass = 0.0;
  double log_scale = 0.0;
  double off_rad = 0.0;
  for (int layer = 0; layer < 4; ++layer) {
    for (const Sheet& sheet : sheets_) {
      const double aside_rad =
          wrap_angle(yaw_rad_ + layer * kPi / 2.0 + sheet.turn_rad - facing_rad);
      if (std::abs(aside_rad) > kSameWay_rad) {
        continue;
      }
      const Point2 offset = turned(sheet.offset, layer * kPi / 2.0);
      for (const Cell c : near) {
        const auto w = static_cast<double>(
            sheet.layers[static_cast<std::size_t>(layer)][parts_.padded_index(c)]);
        sum = sum + w * (middle_of(c) + offset);
        log_scale += w * std::log(sheet.scale);
        off_rad += w * aside_rad;
        mass += w;
      }
    }
  }
  position_cells_ = (1.0 / (mass * parts_.cuts())) * sum;
  scale_ = std::exp(log_scale / mass);
  // With quarter turns alone aside_rad is nothing but rounding.
  grid_yaw_rad_ = wrap_angle(turns() == 1 ? facing_rad : facing_rad + off_rad / mass);
  confidence_ = mass;
}

Localization ScaleFilter::localization() const {
  return {belief_,
          estimate_,
          position_cells_,
          grid_yaw_rad_,
          confidence_,
          confidence_ >= converged_confidence_,
          scale_,
          compass_.axes_yaw_rad(),
          is_shown_listed_ ? &shown_ : nullptr,
          &looks_};
}

}  // namespace cmn
