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

/// Of the greatest weight; less is dropped, and with it the work on it.
constexpr float kLeastShare = 1e-9F;
/// Share of a whole new look in the running mean of the fit.
constexpr double kFitGain = 0.3;
/// Free rays are probed at these shares of their range.
constexpr std::array<double, 3> kProbes{0.3, 0.6, 0.85};

Cell rounded(Point2 p) {
  return {static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y))};
}

}  // namespace

ScaleFilter::ScaleFilter(const CoarseMap& map, const ScaleFilterParams& params,
                         double converged_confidence)
    : map_{map},
      params_{params},
      converged_confidence_{converged_confidence},
      table_{map, code_},
      // No ray leaves the field, at any scale.
      field_{map, params.reach_m * std::max({1.0, params.least_scale, params.greatest_scale}),
             params.field_sigma_m, params.field_random},
      compass_{params.compass},
      belief_{map.width(), map.height()} {
  stride_ = belief_.stride();
  for (int i = 0; i < params.scales; ++i) {
    Sheet sheet;
    const double share = params.scales == 1 ? 0.0 : static_cast<double>(i) / (params.scales - 1);
    sheet.scale =
        params.scales == 1
            ? 1.0
            : params.least_scale * std::pow(params.greatest_scale / params.least_scale, share);
    sheets_.push_back(std::move(sheet));
  }
  for (int error = -255; error <= 255; ++error) {
    const double share = code_.step() * error / params.range_sigma;
    const double match = std::exp(-0.5 * share * share);
    // Shorter than expected: clutter; and where nothing was hit, all that one can say.
    const double hit = match + (error < 0 ? params.range_short : 0.0);
    const double free = error < 0 ? 1.0 + params.range_short : match;
    log_of_hit_.push_back(static_cast<float>(std::log(hit + params.range_random)));
    log_of_free_.push_back(static_cast<float>(std::log(free + params.range_random)));
  }
  scratch_.assign(belief_.padded_size(), 0.0F);
  reset();
}

double ScaleFilter::spread(const std::function<double(Heading, Cell)>& weight_of, double each) {
  double total = 0.0;
  for (Sheet& sheet : sheets_) {
    const double off = std::log(sheet.scale) / params_.scale_sigma;
    const double prior = each * std::exp(-0.5 * off * off);
    for (const Heading heading : kHeadings) {
      const auto layer = static_cast<std::size_t>(index(heading));
      std::vector<float>& weight = sheet.weight[layer];
      std::vector<std::uint32_t>& support = sheet.support[layer];
      for (std::size_t i = 0; i < map_.occupied().size(); ++i) {
        const Cell c = map_.occupied().cell_at(i);
        const std::size_t at = belief_.padded_index(c);
        const double share = map_.is_free(c) ? 1.0 : params_.rim_penalty;
        const auto more =
            table_.may_stand(at) ? static_cast<float>(prior * share * weight_of(heading, c)) : 0.0F;
        if (more > 0.0F && weight[at] == 0.0F) {
          support.push_back(static_cast<std::uint32_t>(at));
        }
        weight[at] += more;
        total += static_cast<double>(more);
      }
    }
  }
  return total;
}

void ScaleFilter::start(const std::function<double(Heading, Cell)>& weight_of) {
  for (Sheet& sheet : sheets_) {
    sheet.offset = {};
    for (std::size_t layer = 0; layer < 4; ++layer) {
      sheet.weight[layer].assign(belief_.padded_size(), 0.0F);
      sheet.support[layer].clear();
    }
  }
  p_odom_last_.reset();
  yaw_rad_ = 0.0;
  has_fit_ = false;
  normalise(spread(weight_of, 1.0));
  summarise();
}

void ScaleFilter::reopen() {
  const double states =
      static_cast<double>(sheets_.size()) * 4.0 * static_cast<double>(map_.free_count());
  const double each = params_.reopen_share / std::max(1e-6, 1.0 - params_.reopen_share) / states;
  normalise(1.0 + spread([](Heading, Cell) { return 1.0; }, each));
  has_fit_ = false;
}

void ScaleFilter::reset() {
  start([](Heading, Cell) { return 1.0; });
}

void ScaleFilter::reset_heading(Heading heading) {
  start([&](Heading h, Cell) { return h == heading ? 1.0 : 0.0; });
}

bool ScaleFilter::reset_near(const Pose2& T_map_robot, double position_sigma_m,
                             double yaw_sigma_rad) {
  const auto weight_of = [&](Heading heading, Cell c) {
    return weight_near(T_map_robot, position_sigma_m, yaw_sigma_rad, map_, heading, c);
  };
  bool is_near_free = false;
  for (std::size_t i = 0; i < map_.occupied().size() && !is_near_free; ++i) {
    const Cell c = map_.occupied().cell_at(i);
    is_near_free = map_.is_free(c) && std::any_of(kHeadings.begin(), kHeadings.end(),
                                                  [&](Heading h) { return weight_of(h, c) > 0.0; });
  }
  if (is_near_free) {
    start(weight_of);
  }
  return is_near_free;
}

Cell ScaleFilter::cell_of(std::uint32_t padded_index) const {
  const int i = static_cast<int>(padded_index);
  return {i % stride_ - 1, i / stride_ - 1};
}

ScaleFilter::Evidence ScaleFilter::evidence(const RayProfile& rays, const Sheet& sheet,
                                            int layer) const {
  Evidence evidence;
  int known = 0;
  for (const Ray& ray : rays) {
    known += ray.is_known();
  }
  const auto range_weight = static_cast<float>(known > 0 ? params_.range_weight / known : 0.0);
  const int cap = code_.coded(params_.reach_m * sheet.scale);
  for (int b = 0; b < kBearings; ++b) {
    const Ray& ray = rays[static_cast<std::size_t>(b)];
    auto& by_code = evidence.by_code[static_cast<std::size_t>(b)];
    if (!ray.is_known()) {
      by_code.fill(0.0F);
      continue;
    }
    const int seen = code_.coded(ray.range_m * sheet.scale);
    const std::vector<float>& of_error = ray.is_hit ? log_of_hit_ : log_of_free_;
    for (int q = 0; q < 256; ++q) {
      by_code[static_cast<std::size_t>(q)] =
          range_weight * of_error[static_cast<std::size_t>(seen - std::min(q, cap) + 255)];
    }
    const Point2 ahead = turned(Point2{1.0, 0.0}, bearing_rad(b));
    const auto offset_at = [&](double range_m) {
      return field_.offset_of(turned(
          rounded(sheet.offset + (range_m * sheet.scale / map_.resolution()) * ahead), layer));
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
                                         std::uint32_t cell) const {
  const std::uint8_t* expected = table_.row(cell);
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

double ScaleFilter::log_likelihood(const Evidence& evidence, int layer, std::uint32_t cell) const {
  const std::ptrdiff_t at = field_.index_of(cell_of(cell));
  float hits = 0.0F;
  for (const std::ptrdiff_t offset : evidence.hits) {
    hits += field_.log_hit(at + offset);
  }
  float frees = 0.0F;
  for (const std::ptrdiff_t offset : evidence.frees) {
    frees += field_.occupied(at + offset);
  }
  return range_log_likelihood(evidence, layer, cell) +
         params_.field_weight * static_cast<double>(hits) /
             std::max<double>(1.0, static_cast<double>(evidence.hits.size())) -
         params_.free_weight * static_cast<double>(frees) /
             std::max<double>(1.0, static_cast<double>(evidence.frees.size()));
}

bool ScaleFilter::weigh(const RayProfile& rays, double news) {
  // Logs first: only their differences matter, so the greatest becomes 1.
  double greatest = -std::numeric_limits<double>::infinity();
  double fit = 0.0;
  std::vector<std::array<std::vector<float>, 4>> logs(sheets_.size());
  for (std::size_t s = 0; s < sheets_.size(); ++s) {
    for (int layer = 0; layer < 4; ++layer) {
      const auto& support = sheets_[s].support[static_cast<std::size_t>(layer)];
      if (support.empty()) {
        continue;
      }
      const Evidence look = evidence(rays, sheets_[s], layer);
      std::vector<float>& log = logs[s][static_cast<std::size_t>(layer)];
      log.reserve(support.size());
      for (const std::uint32_t i : support) {
        const double rim = map_.is_free(cell_of(i)) ? 0.0 : std::log(params_.rim_penalty + 1e-9);
        const double value =
            news * (log_likelihood(look, layer, i) + rim) +
            std::log(static_cast<double>(sheets_[s].weight[static_cast<std::size_t>(layer)][i]));
        log.push_back(static_cast<float>(value));
        if (value > greatest) {
          greatest = value;
          fit = range_log_likelihood(look, layer, i) / std::max(1e-9, params_.range_weight);
        }
      }
    }
  }
  if (!std::isfinite(greatest)) {
    return false;
  }
  double total = 0.0;
  for (std::size_t s = 0; s < sheets_.size(); ++s) {
    for (std::size_t layer = 0; layer < 4; ++layer) {
      auto& support = sheets_[s].support[layer];
      auto& weight = sheets_[s].weight[layer];
      std::size_t kept = 0;
      for (std::size_t j = 0; j < support.size(); ++j) {
        const std::uint32_t i = support[j];
        const float w = std::exp(logs[s][layer][j] - static_cast<float>(greatest));
        weight[i] = w > kLeastShare ? w : 0.0F;
        if (w > kLeastShare) {
          support[kept++] = i;
          total += static_cast<double>(w);
        }
      }
      support.resize(kept);
    }
  }
  normalise(total);
  fit_ = has_fit_ ? fit_ + std::min(1.0, kFitGain * news) * (fit - fit_) : fit;
  has_fit_ = true;
  return true;
}

void ScaleFilter::normalise(double total) {
  const auto factor = static_cast<float>(1.0 / total);
  for (Sheet& sheet : sheets_) {
    for (std::size_t layer = 0; layer < 4; ++layer) {
      for (const std::uint32_t i : sheet.support[layer]) {
        sheet.weight[layer][i] *= factor;
      }
    }
  }
}

Correction ScaleFilter::update(const LocalOccupancy& seen, const Pose2& T_odom_robot) {
  compass_.look(seen, T_odom_robot.yaw);
  const Pose2 T_axes_robot = Pose2{0.0, 0.0, -compass_.axes_yaw_rad()} * T_odom_robot;
  Point2 driven;
  double news = 1.0;
  if (p_odom_last_) {
    driven = turned(T_odom_robot.position() - *p_odom_last_, -compass_.axes_yaw_rad());
    news = std::min(1.0, norm(driven) / params_.independence_m);
  } else {
    // Till now layers were headings: see start().
    const int quarters = index(nearest_heading(T_axes_robot.yaw));
    for (Sheet& sheet : sheets_) {
      std::rotate(sheet.weight.begin(), sheet.weight.begin() + quarters, sheet.weight.end());
      std::rotate(sheet.support.begin(), sheet.support.begin() + quarters, sheet.support.end());
    }
  }
  p_odom_last_ = T_odom_robot.position();
  for (Sheet& sheet : sheets_) {
    move(sheet, driven);
  }
  Correction outcome = Correction::kApplied;
  if (news > 0.0 && !weigh(cast_rays(seen, T_axes_robot.yaw, params_.reach_m), news)) {
    // The odometry led all hypotheses into walls: the robot may be anywhere.
    normalise(spread([](Heading, Cell) { return 1.0; }, 1.0));
    has_fit_ = false;
    outcome = Correction::kContradiction;
  }
  if (has_fit_ && fit_ < params_.reopen_fit && confidence_ >= converged_confidence_) {
    reopen();
    outcome = Correction::kReopened;
  }
  yaw_rad_ = T_axes_robot.yaw;
  summarise();
  return outcome;
}

std::vector<double> ScaleFilter::scale_marginal() const {
  std::vector<double> marginal;
  for (const Sheet& sheet : sheets_) {
    double mass = 0.0;
    for (std::size_t layer = 0; layer < 4; ++layer) {
      for (const std::uint32_t i : sheet.support[layer]) {
        mass += static_cast<double>(sheet.weight[layer][i]);
      }
    }
    marginal.push_back(mass);
  }
  return marginal;
}

void ScaleFilter::summarise() {
  for (const auto& [heading, i] : shown_) {
    belief_.layer(heading)[i] = 0.0;
  }
  shown_.clear();
  belief_.set_factor(1.0);
  const int quarters = nearest_quarter(yaw_rad_);
  double best = -1.0;
  int best_layer = 0;
  std::uint32_t best_cell = 0;
  for (int layer = 0; layer < 4; ++layer) {
    const Heading heading = turned(static_cast<Heading>(layer), quarters);
    std::vector<double>& shown = belief_.layer(heading);
    for (const Sheet& sheet : sheets_) {
      for (const std::uint32_t i : sheet.support[static_cast<std::size_t>(layer)]) {
        if (shown[i] == 0.0) {
          shown_.emplace_back(heading, i);
        }
        shown[i] += static_cast<double>(sheet.weight[static_cast<std::size_t>(layer)][i]);
        if (shown[i] > best) {
          best = shown[i];
          best_layer = layer;
          best_cell = i;
        }
      }
    }
  }
  estimate_ = {turned(static_cast<Heading>(best_layer), quarters), cell_of(best_cell), best};
  // The mean of what lies within 1 m of the best cell: finer than a cell, and the scale there.
  const double radius = 1.0 / map_.resolution();
  const auto layer = static_cast<std::size_t>(best_layer);
  Point2 sum;
  double mass = 0.0;
  double log_scale = 0.0;
  for (const Sheet& sheet : sheets_) {
    const Point2 offset = turned(sheet.offset, best_layer * kPi / 2.0);
    for (const std::uint32_t i : sheet.support[layer]) {
      const Cell c = cell_of(i);
      const Cell off = c - estimate_.cell;
      if (off.x * off.x + off.y * off.y <= radius * radius) {
        const auto w = static_cast<double>(sheet.weight[layer][i]);
        sum = sum + w * (middle_of(c) + offset);
        log_scale += w * std::log(sheet.scale);
        mass += w;
      }
    }
  }
  position_cells_ = (1.0 / mass) * sum;
  scale_ = std::exp(log_scale / mass);
  confidence_ = mass;
}

Localization ScaleFilter::localization() const {
  const double residual = wrap_angle(yaw_rad_ - nearest_quarter(yaw_rad_) * kPi / 2.0);
  return {belief_,         estimate_,
          position_cells_, wrap_angle(yaw(estimate_.heading) + residual),
          confidence_,     confidence_ >= converged_confidence_,
          scale_,          compass_.axes_yaw_rad()};
}

}  // namespace cmn
