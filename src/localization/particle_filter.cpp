// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/particle_filter.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>

namespace cmn {
namespace {

/// No drawing is farther than this factor from its nominal scale: bounds of the random walk.
constexpr double kMostScale = 2.0;

double clamped_scale(double scale) { return std::clamp(scale, 1.0 / kMostScale, kMostScale); }

/// One of the n x n parts of the observation, as a point to look up on the drawing.
struct Spot {
  Point2 p_robot;      ///< [m]
  double if_occupied;  ///< what the MSE grows by when the drawing is occupied there
};

}  // namespace

ParticleFilter::ParticleFilter(const CoarseMap& map, const LocalizationParams& params)
    : map_{map},
      params_{params},
      rng_{params.seed},
      particles_(static_cast<std::size_t>(params.particles.count)),
      likelihoods_(particles_.size()),
      belief_{map.width(), map.height()} {
  const double reach_m = std::sqrt(0.5) * params.measurement.window_m;
  margin_ = 2 + static_cast<int>(reach_m * kMostScale / map.resolution());
  stride_ = map.width() + 2 * margin_;
  is_occupied_.assign(static_cast<std::size_t>(stride_ * (map.height() + 2 * margin_)), 1);
  for (std::size_t i = 0; i < map.occupied().size(); ++i) {
    const Cell c = map.occupied().cell_at(i);
    if (map.is_free(c)) {
      free_cells_.push_back(c);
      is_occupied_[slot_of(middle_of(c))] = 0;
    }
  }
  assert(!free_cells_.empty());
  reset();
}

void ParticleFilter::reset() { start(std::nullopt); }
void ParticleFilter::reset_heading(Heading heading) { start(heading); }

Point2 ParticleFilter::anywhere(double share) {
  const auto i = static_cast<std::size_t>(share * static_cast<double>(free_cells_.size()));
  const Cell c = free_cells_[std::min(i, free_cells_.size() - 1)];
  return {c.x + draw_uniform(rng_), c.y + draw_uniform(rng_)};
}

double ParticleFilter::any_scale() {
  return clamped_scale(std::exp(params_.particles.scale_spread * draw_normal(rng_)));
}

void ParticleFilter::start(std::optional<Heading> heading) {
  const auto count = static_cast<double>(particles_.size());
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    Particle& particle = particles_[i];
    // Drawn from as many equal parts of the map as there are particles: no part is left out.
    particle.position = anywhere((static_cast<double>(i) + draw_uniform(rng_)) / count);
    particle.yaw = yaw(heading ? *heading : turned(Heading::kEast, static_cast<int>(i % 4)));
    particle.scale = any_scale();
    particle.weight = 1.0 / count;
  }
  restart();
}

bool ParticleFilter::reset_near(const Pose2& T_map_robot, double position_sigma_m,
                                double yaw_sigma_rad) {
  std::vector<Estimate> near;  // with the sum of the weights so far for a probability
  double total = 0.0;
  for (const Cell c : free_cells_) {
    for (const Heading h : kHeadings) {
      const double weight = weight_near(T_map_robot, position_sigma_m, yaw_sigma_rad, map_, h, c);
      if (weight > 0.0) {
        total += weight;
        near.push_back({h, c, total});
      }
    }
  }
  if (near.empty()) {
    return false;
  }
  const auto count = static_cast<double>(particles_.size());
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    // Drawn from equal parts of the weight (Thrun et al. 2005, Table 4.4).
    const double sum = (static_cast<double>(i) + draw_uniform(rng_)) / count * total;
    const auto state =
        std::lower_bound(near.begin(), std::prev(near.end()), sum,
                         [](const Estimate& e, double s) { return e.probability < s; });
    particles_[i] = {{state->cell.x + draw_uniform(rng_), state->cell.y + draw_uniform(rng_)},
                     yaw(state->heading),
                     any_scale(),
                     1.0 / count};
  }
  restart();
  return true;
}

void ParticleFilter::restart() {
  T_odom_last_.reset();
  contradictions_in_a_row_ = 0;
  publish(0.0);
}

void ParticleFilter::predict(const Pose2& T_start_end) {
  const double way_m = norm(T_start_end.position());
  const double turn_m = std::abs(T_start_end.yaw) / (kPi / 2.0);
  const double travel_sigma_m = params_.particles.travel_noise * std::sqrt(way_m);
  const double scale_sigma = params_.particles.scale_noise * std::sqrt(way_m);
  const double yaw_sigma = params_.particles.yaw_noise * std::sqrt(way_m + turn_m);
  for (Particle& particle : particles_) {
    const auto [yaw_draw, scale_draw] = draw_two_normals(rng_);
    if (way_m > 0.0) {
      const auto [x_draw, y_draw] = draw_two_normals(rng_);
      particle.scale = clamped_scale(particle.scale * (1.0 + scale_sigma * scale_draw));
      const Point2 way =
          (1.0 / (particle.scale * map_.resolution())) *
          turned(T_start_end.position() + travel_sigma_m * Point2{x_draw, y_draw}, particle.yaw);
      // In pieces of no more than a cell, so that no wall is jumped over.
      const int pieces = 1 + static_cast<int>(std::max(std::abs(way.x), std::abs(way.y)));
      for (int i = 0; i < pieces; ++i) {
        const Point2 x_on{particle.position.x + way.x / pieces, particle.position.y};
        particle.position = is_free(x_on) ? x_on : particle.position;
        const Point2 y_on{particle.position.x, particle.position.y + way.y / pieces};
        particle.position = is_free(y_on) ? y_on : particle.position;
      }
    }
    particle.yaw = wrap_angle(particle.yaw + T_start_end.yaw + yaw_sigma * yaw_draw);
  }
}

double ParticleFilter::correct(const LocalOccupancy& seen, double weight) {
  const int n = params_.measurement.window_cells();
  const double spot_m = params_.measurement.window_m / n;
  const std::vector<double> window = reduce(seen, params_.measurement, 0.0);
  std::vector<Spot> spots;
  double if_free = 0.0;
  for (int i = 0; i < n * n; ++i) {
    const double m_hat = window[static_cast<std::size_t>(i)];
    // (1 - m)^2 - m^2 = 1 - 2 m.
    spots.push_back(
        {{(i % n - n / 2) * spot_m, (i / n - n / 2) * spot_m}, (1.0 - 2.0 * m_hat) / (n * n)});
    if_free += m_hat * m_hat / (n * n);
  }
  const double exponent = weight * params_.measurement.exponent;
  double evidence = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const Particle& particle = particles_[i];
    const double cells_per_m = 1.0 / (particle.scale * map_.resolution());
    const double c = cells_per_m * std::cos(particle.yaw);
    const double s = cells_per_m * std::sin(particle.yaw);
    double mse = if_free;
    for (const Spot& spot : spots) {
      const Point2 p{particle.position.x + c * spot.p_robot.x - s * spot.p_robot.y,
                     particle.position.y + s * spot.p_robot.x + c * spot.p_robot.y};
      mse += is_occupied_[slot_of(p)] * spot.if_occupied;
    }
    const double overlap = std::max(0.0, 1.0 - mse);
    likelihoods_[i] = exponent == 2.0 ? overlap * overlap : std::pow(overlap, exponent);
    evidence += particle.weight * likelihoods_[i];
  }
  if (!(evidence > params_.contradiction_evidence) || !std::isfinite(evidence)) {
    return 0.0;
  }
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    particles_[i].weight *= likelihoods_[i] / evidence;
  }
  return evidence;
}

Correction ParticleFilter::update(const LocalOccupancy& seen, const Pose2& T_odom_robot) {
  double news = 1.0;
  if (T_odom_last_) {
    const Pose2 T_start_end = inverse(*T_odom_last_) * T_odom_robot;
    news = params_.news_in(norm(T_start_end.position()));
    predict(T_start_end);
  } else {
    for (Particle& particle : particles_) {
      particle.yaw = wrap_angle(particle.yaw + residual_yaw(T_odom_robot));
    }
  }
  T_odom_last_ = T_odom_robot;

  Correction outcome = Correction::kApplied;
  if (correct(seen, news) > 0.0) {
    contradictions_in_a_row_ = 0;
    double squares = 0.0;
    for (const Particle& particle : particles_) {
      squares += particle.weight * particle.weight;
    }
    if (1.0 / squares < 0.5 * static_cast<double>(particles_.size())) {
      resample();
      renew(params_.particles.renewed_share, false);
    }
  } else if (++contradictions_in_a_row_ >= params_.reopen_after) {
    contradictions_in_a_row_ = 0;
    outcome = Correction::kReopened;
    resample();
    renew(params_.reopen_weight, true);
  } else {
    outcome = Correction::kContradiction;
  }
  publish(residual_yaw(T_odom_robot));
  return outcome;
}

void ParticleFilter::resample() {
  const auto count = static_cast<double>(particles_.size());
  scratch_.clear();
  const double first = draw_uniform(rng_);
  double sum = particles_.front().weight;
  std::size_t from = 0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const double mark = (static_cast<double>(i) + first) / count;
    while (mark > sum && from + 1 < particles_.size()) {
      sum += particles_[++from].weight;
    }
    scratch_.push_back(particles_[from]);
    scratch_.back().weight = 1.0 / count;
  }
  particles_.swap(scratch_);
}

void ParticleFilter::renew(double share, bool is_heading_lost) {
  for (Particle& particle : particles_) {
    if (draw_uniform(rng_) < share) {
      particle.position = anywhere(draw_uniform(rng_));
      particle.scale = any_scale();
      const double turns = is_heading_lost ? static_cast<double>(draw_index(rng_, 4)) : 0.0;
      particle.yaw = wrap_angle(particle.yaw + turns * kPi / 2.0);
    }
  }
}

void ParticleFilter::publish(double residual_yaw_rad) {
  for (const Estimate& at : occupied_states_) {
    belief_.set_weight(at.heading, at.cell, 0.0);
  }
  occupied_states_.clear();
  const auto state_of = [&](const Particle& particle) {
    return Estimate{nearest_heading(particle.yaw - residual_yaw_rad),
                    {static_cast<int>(particle.position.x), static_cast<int>(particle.position.y)}};
  };
  for (const Particle& particle : particles_) {
    const Estimate at = state_of(particle);
    double& weight = belief_.layer(at.heading)[belief_.padded_index(at.cell)];
    if (weight == 0.0 && particle.weight > 0.0) {
      occupied_states_.push_back(at);
    }
    weight += particle.weight;
  }

  const auto mass_about = [&](const Estimate& at) {
    const std::vector<double>& layer = belief_.layer(at.heading);
    double mass = 0.0;
    for (int dy = -1; dy <= 1; ++dy) {
      const std::size_t i = belief_.padded_index(at.cell + Cell{-1, dy});
      mass += layer[i] + layer[i + 1] + layer[i + 2];
    }
    return mass;
  };
  Estimate best;
  double most = 0.0;
  for (const Estimate& at : occupied_states_) {
    const double mass = mass_about(at);
    if (mass > most) {
      most = mass;
      best = at;
    }
  }

  Point2 sum;
  double sum_scale = 0.0;
  double sum_yaw = 0.0;
  const double axis_rad = yaw(best.heading) + residual_yaw_rad;
  for (const Particle& particle : particles_) {
    const Estimate at = state_of(particle);
    if (at.heading == best.heading && std::abs(at.cell.x - best.cell.x) <= 1 &&
        std::abs(at.cell.y - best.cell.y) <= 1) {
      sum = sum + particle.weight * particle.position;
      sum_scale += particle.weight * particle.scale;
      sum_yaw += particle.weight * wrap_angle(particle.yaw - axis_rad);
    }
  }
  position_cells_ = (1.0 / most) * sum;
  scale_ = sum_scale / most;
  yaw_rad_ = wrap_angle(axis_rad + sum_yaw / most);
  const Cell middle{static_cast<int>(position_cells_.x), static_cast<int>(position_cells_.y)};
  if (map_.is_free(middle)) {
    best.cell = middle;
  } else {  // the particles stand around a corner or on both sides of a wall
    position_cells_ = middle_of(best.cell);
  }
  best.probability = belief_(best.heading, best.cell);
  estimate_ = best;
  confidence_ = mass_near(belief_, estimate_, 1.0 / map_.resolution());
}

}  // namespace cmn
