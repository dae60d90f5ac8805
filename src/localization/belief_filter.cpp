// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/belief_filter.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace cmn {
namespace {

/// Lies on no map, so that the next look at the belief chooses afresh.
constexpr Estimate kNoEstimate{Heading::kEast, {-1, -1}, 0.0};

/// Weights below this are taken for 0: far below them lie the subnormal numbers, with which a step
/// takes many times as long.
constexpr double kTiny = 1e-250;

struct RowSummary {
  double sum = 0.0;
  double peak = 0.0;
};

/// Two neighbouring cells: the width of the vectors that every 64 bit processor has.
using Pair = double __attribute__((vector_size(16)));
Pair pair_at(const double* p) { return Pair{p[0], p[1]}; }
Pair max(Pair a, Pair b) { return a > b ? a : b; }

/// Some neighbours of a filter step: out = moved(in), weighed. `Shares`: of each kind of cells.
template <class Shares>
RowSummary step_run(const double* in, const double* in_behind, const std::uint32_t* kinds,
                    const Shares* shares, int count, double* out) {
  const Pair tiny{kTiny, kTiny};
  Pair sum{};
  Pair peak{};
  int i = 0;
  for (; i + 2 <= count; i += 2) {
    const Shares& first = shares[kinds[i]];
    const Shares& second = shares[kinds[i + 1]];
    Pair weight = Pair{first.stay, second.stay} * pair_at(in + i) +
                  Pair{first.come, second.come} * pair_at(in_behind + i);
    weight = weight > tiny ? weight : Pair{};
    out[i] = weight[0];
    out[i + 1] = weight[1];
    sum += weight;
    peak = max(peak, weight);
  }
  if (i < count) {
    const Shares& last = shares[kinds[i]];
    const double weight = last.stay * in[i] + last.come * in_behind[i];
    out[i] = weight > kTiny ? weight : 0.0;
    sum[0] += out[i];
    peak[0] = std::max(peak[0], out[i]);
  }
  return {sum[0] + sum[1], std::max(peak[0], peak[1])};
}

/// Of the peaks of a layer's rows: none of its cells holds anything.
bool is_empty(const std::vector<double>& peaks) {
  return std::all_of(peaks.begin(), peaks.end(), [](double peak) { return peak == 0.0; });
}

}  // namespace

BeliefFilter::BeliefFilter(CoarseMap map, const LocalizationParams& params)
    : map_{std::move(map)},
      params_{params},
      motion_{make_motion_model(params.motion, map_.resolution())},
      measurement_{make_measurement_model(params.measurement, map_)},
      shares_(measurement_->kinds().size()),
      rng_{params.seed},
      scratch_{map_.width(), map_.height()} {
  for (RowPeaks* peaks : {&peaks_, &scratch_peaks_}) {
    peaks->fill(std::vector<double>(static_cast<std::size_t>(map_.height()), 0.0));
  }
  reset();
}

void BeliefFilter::reset() { restart(Belief::uniform(map_)); }

void BeliefFilter::reset_heading(Heading heading) {
  Belief known{map_.width(), map_.height()};
  for (std::size_t i = 0; i < map_.occupied().size(); ++i) {
    const Cell c = map_.occupied().cell_at(i);
    known.set_weight(heading, c, map_.is_free(c) ? 1.0 : 0.0);
  }
  known.normalise();
  restart(std::move(known));
}

bool BeliefFilter::reset_near(const Pose2& T_map_robot, double position_sigma_m,
                              double yaw_sigma_rad) {
  Belief near{map_.width(), map_.height()};
  for (std::size_t i = 0; i < map_.occupied().size(); ++i) {
    const Cell c = map_.occupied().cell_at(i);
    for (const Heading h : kHeadings) {
      near.set_weight(h, c,
                      map_.is_free(c)
                          ? weight_near(T_map_robot, position_sigma_m, yaw_sigma_rad, map_, h, c)
                          : 0.0);
    }
  }
  if (!near.normalise()) {
    return false;
  }
  restart(std::move(near));
  return true;
}

double BeliefFilter::apply(const Shift& shift, int rolled, const Likelihood* likelihood,
                           double least) {
  const WindowKinds& kinds = measurement_->kinds();
  double total = 0.0;
  for (const Heading h : kHeadings) {
    const auto k = static_cast<std::size_t>(index(h));
    if (is_empty(peaks_[k])) {
      if (!is_empty(scratch_peaks_[k])) {
        std::fill(scratch_.layer(h).begin(), scratch_.layer(h).end(), 0.0);
        std::fill(scratch_peaks_[k].begin(), scratch_peaks_[k].end(), 0.0);
      }
      continue;
    }
    const Cell step = unit_step(turned(h, shift.quarter_turn - rolled));
    for (std::size_t kind = 1; kind < kinds.size(); ++kind) {
      const bool may_leave = (kinds.neighbourhoods[kind] & neighbour_bit(step)) == 0;
      // With the factor in it, the weights stay near 1 in sum however many steps there are.
      const double weight =
          belief_.factor() * (likelihood == nullptr ? 1.0 : (*likelihood)[k][kind]);
      shares_[kind] = {weight * (may_leave ? 1.0 - shift.share : 1.0), weight * shift.share};
    }
    total += step_layer(h, step);
  }
  if (!(total > least) || !std::isfinite(total)) {
    return 0.0;
  }
  scratch_.set_factor(1.0 / total);
  std::swap(belief_, scratch_);
  std::swap(peaks_, scratch_peaks_);
  return total;
}

double BeliefFilter::step_layer(Heading heading, Cell step) {
  const std::vector<double>& peaks = peaks_[static_cast<std::size_t>(index(heading))];
  std::vector<double>& new_peaks = scratch_peaks_[static_cast<std::size_t>(index(heading))];
  const double* in = belief_.layer(heading).data();
  double* out = scratch_.layer(heading).data();
  const WindowKinds& map = measurement_->kinds();
  const auto holds = [&](int y) {
    return y >= 0 && y < map_.height() && peaks[static_cast<std::size_t>(y)] > 0.0;
  };
  double total = 0.0;
  for (auto run = map.runs.begin(); run != map.runs.end();) {
    const int y = run->first.y;
    double& new_peak = new_peaks[static_cast<std::size_t>(y)];
    const bool comes_something = holds(y) || holds(y - step.y);
    const bool must_clear = new_peak > 0.0;
    new_peak = 0.0;
    for (; run != map.runs.end() && run->first.y == y; ++run) {
      const std::size_t first = belief_.padded_index(run->first);
      if (comes_something) {
        const RowSummary done =
            step_run(in + first, in + belief_.padded_index(run->first - step),
                     map.of_cell.data() + first, shares_.data(), run->count, out + first);
        total += done.sum;
        new_peak = std::max(new_peak, done.peak);
      } else if (must_clear) {
        std::fill_n(out + first, run->count, 0.0);
      }
    }
  }
  return total;
}

HeadingSet BeliefFilter::possible_headings() const {
  HeadingSet headings{};
  for (std::size_t k = 0; k < headings.size(); ++k) {
    headings[k] = !is_empty(peaks_[k]);
  }
  return headings;
}

void BeliefFilter::turn(int quarter_turns) {
  belief_.roll(quarter_turns);
  const int q = ((quarter_turns % 4) + 4) % 4;
  std::rotate(peaks_.begin(), peaks_.end() - q, peaks_.end());
}

void BeliefFilter::restart(Belief belief) {
  start_from(std::move(belief));
  estimate_ = kNoEstimate;
  forget_odometry();
  contradictions_in_a_row_ = 0;
  summarise();
}

void BeliefFilter::start_from(Belief belief) {
  belief_ = std::move(belief);
  for (const Heading h : kHeadings) {
    for (int y = 0; y < map_.height(); ++y) {
      const double* row = belief_.layer(h).data() + belief_.padded_index({0, y});
      peaks_[static_cast<std::size_t>(index(h))][static_cast<std::size_t>(y)] =
          *std::max_element(row, row + map_.width());
    }
  }
}

void BeliefFilter::predict(const Displacement& driven) {
  for (const Shift& shift : shifts(motion_->steps(driven, rng_))) {
    apply(shift, 0, nullptr, 0.0);
  }
  turn(driven.quarter_turns);
  summarise();
}

Correction BeliefFilter::correct(const LocalOccupancy& seen, double residual_yaw_rad,
                                 double weight) {
  const Likelihood& likelihood =
      measurement_->measure(seen, residual_yaw_rad, weight, possible_headings());
  return settle(apply({0, 0.0}, 0, &likelihood, params_.contradiction_evidence));
}

Correction BeliefFilter::update(const LocalOccupancy& seen, const Pose2& T_odom_robot) {
  const bool is_first = !T_odom_last_;
  const Displacement driven =
      T_odom_last_ ? displacement(*T_odom_last_, T_odom_robot) : Displacement{};
  T_odom_last_ = T_odom_robot;
  std::vector<Shift> moves = shifts(motion_->steps(driven, rng_));
  if (moves.empty()) {
    moves.push_back({0, 0.0});
  }
  // The last move and the correction share one pass.
  turn(driven.quarter_turns);
  for (std::size_t i = 0; i + 1 < moves.size(); ++i) {
    apply(moves[i], driven.quarter_turns, nullptr, 0.0);
  }
  const Likelihood& likelihood = measurement_->measure(
      seen, residual_yaw(T_odom_robot),
      is_first ? 1.0 : params_.news_in(std::hypot(driven.forward_m, driven.left_m)),
      possible_headings());
  const double evidence =
      apply(moves.back(), driven.quarter_turns, &likelihood, params_.contradiction_evidence);
  if (evidence == 0.0) {
    apply(moves.back(), driven.quarter_turns, nullptr, 0.0);
  }
  return settle(evidence);
}

double BeliefFilter::yaw_rad() const {
  return yaw(estimate_.heading) + (T_odom_last_ ? residual_yaw(*T_odom_last_) : 0.0);
}

Correction BeliefFilter::settle(double evidence) {
  Correction outcome = Correction::kApplied;
  if (evidence > 0.0) {
    contradictions_in_a_row_ = 0;
  } else {
    outcome = Correction::kContradiction;
    if (++contradictions_in_a_row_ >= params_.reopen_after) {
      contradictions_in_a_row_ = 0;
      outcome = Correction::kReopened;
      Belief mixed = Belief::uniform(map_);
      for (const Heading h : kHeadings) {
        for (std::size_t i = 0; i < mixed.padded_size(); ++i) {
          mixed.layer(h)[i] =
              (1.0 - params_.reopen_weight) * belief_.factor() * belief_.layer(h)[i] +
              params_.reopen_weight * mixed.factor() * mixed.layer(h)[i];
        }
      }
      mixed.normalise();
      start_from(std::move(mixed));
    }
  }
  summarise();
  return outcome;
}

void BeliefFilter::summarise() {
  double best = 0.0;
  for (const std::vector<double>& peaks : peaks_) {
    best = std::max(best, *std::max_element(peaks.begin(), peaks.end()));
  }
  // Sums taken in another order differ in the last digits; such cells are equals.
  const double least = best * (1.0 - 1e-9);
  const auto weight_of = [&](Heading h, Cell c) {
    return belief_.layer(h)[belief_.padded_index(c)];
  };
  const bool is_still_best =
      belief_.contains(estimate_.cell) && weight_of(estimate_.heading, estimate_.cell) >= least;
  if (!is_still_best) {
    std::vector<Estimate> equals;
    for (const Heading h : kHeadings) {
      for (int y = 0; y < map_.height(); ++y) {
        const bool may_hold_one =
            peaks_[static_cast<std::size_t>(index(h))][static_cast<std::size_t>(y)] >= least;
        for (int x = 0; may_hold_one && x < map_.width(); ++x) {
          if (weight_of(h, {x, y}) >= least && map_.is_free({x, y})) {
            equals.push_back({h, {x, y}});
          }
        }
      }
    }
    estimate_ = equals[draw_index(rng_, equals.size())];
  }
  estimate_.probability = belief_(estimate_.heading, estimate_.cell);
  confidence_ = mass_near(belief_, estimate_, 1.0 / map_.resolution());
}

}  // namespace cmn
