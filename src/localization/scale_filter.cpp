// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/scale_filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace cmn {
namespace {

/// A look that contradicts the last by so much is to be explained by the drawing, on its own.
constexpr double kDoubtedShare = 0.05;

}  // namespace

ScaleFilter::ScaleFilter(const CoarseMap& map, const ScaleFilterParams& params,
                         double converged_confidence)
    : map_{map},
      params_{params},
      model_{std::make_shared<RangeModel>(map, params)},
      parts_{model_->parts},
      looks_{model_, params},
      converged_confidence_{converged_confidence},
      // No ray leaves the field, at any scale.
      field_{parts_.map(),
             params.reach_m * std::max({1.0, params.least_scale, params.greatest_scale}),
             params.field_sigma_m, params.field_random},
      compass_{params.compass},
      belief_{map.width(), map.height()} {
  for (int i = 0; i < params.scales; ++i) {
    const double share = params.scales == 1 ? 0.0 : static_cast<double>(i) / (params.scales - 1);
    const double scale =
        params.scales == 1
            ? 1.0
            : params.least_scale * std::pow(params.greatest_scale / params.least_scale, share);
    for (int j = 0; j < turns(); ++j) {
      Sheet sheet;
      sheet.scale = scale;
      sheet.turn_rad = 2.0 * kPi * (j - (turns() - 1) / 2) / params.headings;
      sheets_.push_back(std::move(sheet));
    }
  }
  log_of_rim_ = std::log(params.rim_penalty + 1e-9);
  scratch_ = no_weights();
  reset();
}

WeightLayer ScaleFilter::no_weights() const { return {parts_.padded_size(), most_listed()}; }

double ScaleFilter::spread(const Weights& weight_of, double each) {
  double total = 0.0;
  for (Sheet& sheet : sheets_) {
    const double off = std::log(sheet.scale) / params_.scale_sigma;
    const double prior = each * std::exp(-0.5 * off * off);
    for (const Heading heading : kHeadings) {
      const auto layer = static_cast<std::size_t>(index(heading));
      WeightLayer& weights = sheet.layers[layer];
      weights.unlist();
      for (std::size_t i = 0; i < parts_.map().occupied().size(); ++i) {
        const Cell c = parts_.map().occupied().cell_at(i);
        const std::size_t at = parts_.padded_index(c);
        const double share = parts_.map().is_free(c) ? 1.0 : params_.rim_penalty;
        const auto more =
            model_->table.may_stand(at)
                ? static_cast<float>(prior * share * weight_of(heading, sheet.turn_rad, c))
                : 0.0F;
        weights.add(static_cast<std::uint32_t>(at), more);
        total += static_cast<double>(more);
      }
      weights.settle();
    }
  }
  return total;
}

void ScaleFilter::start(const Weights& weight_of) {
  for (Sheet& sheet : sheets_) {
    sheet.offset = {};
    sheet.layers.fill(no_weights());
  }
  p_odom_last_.reset();
  comparison_ = {};  // a pose that is told after the robot was carried is to last
  yaw_rad_ = 0.0;
  has_fit_ = false;
  normalise(spread(weight_of, 1.0));
  summarise();
}

void ScaleFilter::turn_back(double yaw_rad) {
  const int by = static_cast<int>(std::lround(yaw_rad * params_.headings / (2.0 * kPi)));
  for (std::size_t first = 0; first < sheets_.size(); first += static_cast<std::size_t>(turns())) {
    // All directions of one scale, round the circle.
    std::vector<WeightLayer*> states;
    for (std::size_t layer = 0; layer < 4; ++layer) {
      for (std::size_t j = first; j < first + static_cast<std::size_t>(turns()); ++j) {
        states.push_back(&sheets_[j].layers[layer]);
      }
    }
    std::vector<WeightLayer> before;
    for (WeightLayer* const weights : states) {
      before.push_back(std::move(*weights));
    }
    const int count = params_.headings;
    for (int d = 0; d < count; ++d) {
      *states[static_cast<std::size_t>(d)] =
          std::move(before[static_cast<std::size_t>(((d + by) % count + count) % count)]);
    }
  }
}

void ScaleFilter::reopen() {
  const double states =
      static_cast<double>(sheets_.size()) * 4.0 * static_cast<double>(parts_.map().free_count());
  const double each = params_.reopen_share / std::max(1e-6, 1.0 - params_.reopen_share) / states;
  normalise(1.0 + spread([](Heading, double, Cell) { return 1.0; }, each));
  compass_.lose();
  fit_ = 0.0;  // time to find what fits better
}

void ScaleFilter::reset() {
  start([](Heading, double, Cell) { return 1.0; });
}

void ScaleFilter::reset_heading(Heading heading) {
  start([&](Heading h, double turn_rad, Cell) {
    return turned(h, nearest_quarter(turn_rad)) == heading ? 1.0 : 0.0;
  });
}

bool ScaleFilter::reset_near(const Pose2& T_map_robot, double position_sigma_m,
                             double yaw_sigma_rad) {
  const auto weight_of = [&](Heading heading, double turn_rad, Cell c) {
    return weight_near(T_map_robot, position_sigma_m, yaw_sigma_rad, parts_.map(),
                       yaw(heading) + turn_rad, c);
  };
  bool is_near_free = false;
  for (std::size_t i = 0; i < parts_.map().occupied().size() && !is_near_free; ++i) {
    const Cell c = parts_.map().occupied().cell_at(i);
    is_near_free = parts_.map().is_free(c) &&
                   std::any_of(kHeadings.begin(), kHeadings.end(),
                               [&](Heading h) { return weight_of(h, 0.0, c) > 0.0; });
  }
  if (is_near_free) {
    start(weight_of);
  }
  return is_near_free;
}

void ScaleFilter::normalise(double total) {
  const auto factor = static_cast<float>(1.0 / total);
  for (Sheet& sheet : sheets_) {
    for (WeightLayer& weights : sheet.layers) {
      weights.for_each([&](std::uint32_t, float& weight) { weight *= factor; });
    }
  }
}

Correction ScaleFilter::update(const LocalOccupancy& seen, const Pose2& T_odom_robot) {
  Correction outcome = Correction::kApplied;
  const double contradicted = comparison_.next(seen, T_odom_robot);
  if (contradicted > params_.carried_share) {
    reset();
    comparison_.next(seen, T_odom_robot);  // reset() has forgotten this look, too
    compass_.lose();
    outcome = Correction::kReopened;
  } else if (contradicted > kDoubtedShare && params_.carried_share < 1.0) {
    has_fit_ = false;
  }
  compass_.look(seen, T_odom_robot);
  const Pose2 T_axes_robot = Pose2{0.0, 0.0, -compass_.axes_yaw_rad()} * T_odom_robot;
  Point2 driven;
  double news = 1.0;
  if (p_odom_last_) {
    driven = turned(T_odom_robot.position() - *p_odom_last_, -compass_.axes_yaw_rad());
    news = std::min(1.0, norm(driven) / params_.independence_m);
  } else {
    // Till now layers were headings: see start().
    turn_back(T_axes_robot.yaw);
  }
  p_odom_last_ = T_odom_robot.position();
  for (Sheet& sheet : sheets_) {
    move(sheet, turned(driven, sheet.turn_rad));
  }
  if (news > 0.0 && !weigh(seen, T_axes_robot.yaw, news)) {
    // The odometry led all hypotheses into walls: the robot may be anywhere.
    normalise(spread([](Heading, double, Cell) { return 1.0; }, 1.0));
    has_fit_ = false;
    outcome = Correction::kContradiction;
  }
  if (has_fit_ && fit_ < params_.reopen_fit) {
    reopen();
    outcome = Correction::kReopened;
  }
  yaw_rad_ = T_axes_robot.yaw;
  summarise();
  return outcome;
}

}  // namespace cmn
