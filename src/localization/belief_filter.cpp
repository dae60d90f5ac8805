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

/// Less than this share of a cell is no motion but the rounding of sines; each motion costs a pass.
constexpr double kNoShare = 1e-12;

/// By kind of neighbourhood: what a cell keeps of its own weight, and takes of the cell's behind
/// it.
struct Shares {
  std::vector<double> stay;
  std::vector<double> come;
};

struct RowSummary {
  double sum = 0.0;
  double peak = 0.0;
};

/// Two neighbouring cells: the width of the vectors that every 64 bit processor has.
using Pair = double __attribute__((vector_size(16)));
Pair pair_at(const double* p) { return Pair{p[0], p[1]}; }
Pair max(Pair a, Pair b) { return a > b ? a : b; }

/// One row of a filter step: out = L * moved(in), for `count` cells. `likelihood` holds a further
/// factor for each cell, or is null.
template <bool kIsByCell>
RowSummary step_row(const double* in, const double* in_behind, const std::uint16_t* kinds,
                    const Shares& shares, const double* likelihood, int count, double* out) {
  const double* stay = shares.stay.data();
  const double* come = shares.come.data();
  const Pair tiny{kTiny, kTiny};
  Pair sum{};
  Pair peak{};
  int i = 0;
  for (; i + 2 <= count; i += 2) {
    Pair weight = Pair{stay[kinds[i]], stay[kinds[i + 1]]} * pair_at(in + i) +
                  Pair{come[kinds[i]], come[kinds[i + 1]]} * pair_at(in_behind + i);
    if constexpr (kIsByCell) {
      weight *= pair_at(likelihood + i);
    }
    weight = weight > tiny ? weight : Pair{};
    out[i] = weight[0];
    out[i + 1] = weight[1];
    sum += weight;
    peak = max(peak, weight);
  }
  if (i < count) {
    double weight = stay[kinds[i]] * in[i] + come[kinds[i]] * in_behind[i];
    if constexpr (kIsByCell) {
      weight *= likelihood[i];
    }
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
      kinds_{map_},
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

std::vector<BeliefFilter::Shift> BeliefFilter::shifts(const std::vector<CellStep>& steps) {
  std::vector<Shift> shifts;
  for (const CellStep& step : steps) {
    if (std::abs(step.forward) > kNoShare) {
      shifts.push_back({step.forward > 0.0 ? 0 : 2, std::abs(step.forward)});
    }
    if (std::abs(step.left) > kNoShare) {
      shifts.push_back({step.left > 0.0 ? 1 : 3, std::abs(step.left)});
    }
  }
  return shifts;
}

double BeliefFilter::apply(const Shift& shift, int rolled, const Likelihood* likelihood,
                           double least) {
  const std::size_t kinds = kinds_.codes.size();
  Shares shares{std::vector<double>(kinds, 0.0), std::vector<double>(kinds, 0.0)};
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
    const double* values = likelihood == nullptr ? nullptr : likelihood->values[k].data();
    const bool is_by_cell = values != nullptr && !likelihood->is_by_neighbourhood;
    for (std::size_t kind = 1; kind < kinds; ++kind) {
      const std::uint16_t code = kinds_.codes[kind];
      const bool may_leave = (code & neighbour_bit(step)) == 0;
      // With the factor in it, the weights stay near 1 in sum however many steps there are.
      const double weight =
          belief_.factor() * (values == nullptr || is_by_cell ? 1.0 : values[code]);
      shares.stay[kind] = weight * (may_leave ? 1.0 - shift.share : 1.0);
      shares.come[kind] = weight * shift.share;
    }
    const auto step_of_row = is_by_cell ? step_row<true> : step_row<false>;
    for (int y = 0; y < map_.height(); ++y) {
      const std::size_t first = belief_.padded_index({0, y});
      const std::vector<double>& in = belief_.layer(h);
      const RowSummary row =
          step_of_row(in.data() + first, in.data() + belief_.padded_index(Cell{0, y} - step),
                      kinds_.of_cell.data() + first, shares, is_by_cell ? values + first : nullptr,
                      map_.width(), scratch_.layer(h).data() + first);
      total += row.sum;
      scratch_peaks_[k][static_cast<std::size_t>(y)] = row.peak;
    }
  }
  if (!(total > least) || !std::isfinite(total)) {
    return 0.0;
  }
  scratch_.set_factor(1.0 / total);
  std::swap(belief_, scratch_);
  std::swap(peaks_, scratch_peaks_);
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
