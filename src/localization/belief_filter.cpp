// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/belief_filter.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace cmn {
namespace {

/// Lies on no map, so that the next look at the belief chooses afresh.
constexpr Estimate kNoEstimate{Heading::kEast, {-1, -1}, 0.0};

/// One layer's worth of a filter step: out = L * moved(in), over the padded layout.
///
/// `stay` and `come` say, by neighbourhood, what share of a cell's own weight it keeps and what
/// share of the weight of the cell behind it receives. `extra` is a further factor for each cell,
/// or null. Returns the sum of `out`.
struct LayerPass {
  NeighbourhoodTable stay;
  NeighbourhoodTable come;
  const double* extra = nullptr;

  double run(const std::vector<double>& in, std::vector<double>& out,
             const std::vector<std::uint16_t>& codes, std::ptrdiff_t behind, std::size_t first,
             std::size_t last) const {
    return extra == nullptr
               ? sum_of(in, out, codes, behind, first, last, [](std::size_t) { return 1.0; })
               : sum_of(in, out, codes, behind, first, last,
                        [this](std::size_t i) { return extra[i]; });
  }

 private:
  template <class Factor>
  double sum_of(const std::vector<double>& in, std::vector<double>& out,
                const std::vector<std::uint16_t>& codes, std::ptrdiff_t behind, std::size_t first,
                std::size_t last, Factor&& factor) const {
    const double* source = in.data();
    double* target = out.data();
    const std::uint16_t* code = codes.data();
    // Four sums, so that one addition need not wait for the one before.
    std::array<double, 4> sums{};
    const auto at = [&](std::size_t i) {
      const double value =
          factor(i) * (stay[code[i]] * source[i] +
                       come[code[i]] * source[static_cast<std::ptrdiff_t>(i) - behind]);
      target[i] = value;
      return value;
    };
    std::size_t i = first;
    for (; i + 4 <= last; i += 4) {
      sums[0] += at(i);
      sums[1] += at(i + 1);
      sums[2] += at(i + 2);
      sums[3] += at(i + 3);
    }
    for (; i < last; ++i) {
      sums[0] += at(i);
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }
};

}  // namespace

BeliefFilter::BeliefFilter(CoarseMap map, const LocalizationParams& params)
    : map_{std::move(map)},
      params_{params},
      motion_{make_motion_model(params.motion, map_.resolution())},
      measurement_{make_measurement_model(params.measurement, map_)},
      codes_{neighbourhood_codes(map_)},
      rng_{params.seed},
      scratch_{map_.width(), map_.height()} {
  reset();
}

void BeliefFilter::reset() {
  belief_ = Belief::uniform(map_);
  estimate_ = kNoEstimate;
  forget_odometry();
  contradictions_in_a_row_ = 0;
  summarise();
}

bool BeliefFilter::reset_near(const Pose2& T_map_robot, double position_sigma_m,
                              double yaw_sigma_rad) {
  const double position_sigma = std::max(position_sigma_m, 0.5 * map_.resolution());
  const double yaw_sigma = std::max(yaw_sigma_rad, 0.1);
  Belief near{map_.width(), map_.height()};
  for (std::size_t i = 0; i < map_.occupied().size(); ++i) {
    const Cell c = map_.occupied().cell_at(i);
    if (map_.is_occupied(c)) {
      continue;
    }
    const double off = norm(map_.center_of(c) - T_map_robot.position()) / position_sigma;
    for (const Heading h : kHeadings) {
      const double off_yaw =
          wrap_angle(yaw(h) + map_.T_map_grid().yaw - T_map_robot.yaw) / yaw_sigma;
      near.set_weight(h, c, off > 5.0 ? 0.0 : std::exp(-0.5 * (off * off + off_yaw * off_yaw)));
    }
  }
  if (!near.normalise()) {
    return false;
  }
  belief_ = std::move(near);
  estimate_ = kNoEstimate;
  forget_odometry();
  contradictions_in_a_row_ = 0;
  summarise();
  return true;
}

std::vector<BeliefFilter::Shift> BeliefFilter::shifts(const std::vector<CellStep>& steps) {
  std::vector<Shift> shifts;
  for (const CellStep& step : steps) {
    if (step.forward != 0.0) {
      shifts.push_back({step.forward > 0.0 ? 0 : 2, std::abs(step.forward)});
    }
    if (step.left != 0.0) {
      shifts.push_back({step.left > 0.0 ? 1 : 3, std::abs(step.left)});
    }
  }
  return shifts;
}

double BeliefFilter::apply(const Shift& shift, int rolled, const Likelihood* likelihood,
                           double least) {
  const auto stride = static_cast<std::size_t>(belief_.stride());
  const std::size_t last = belief_.padded_size() - stride;
  double total = 0.0;
  for (const Heading h : kHeadings) {
    const Cell step = unit_step(turned(h, shift.quarter_turn - rolled));
    LayerPass layer_pass;
    const std::vector<double>* values =
        likelihood == nullptr ? nullptr : &likelihood->values[static_cast<std::size_t>(index(h))];
    const bool by_code = values != nullptr && likelihood->is_by_neighbourhood;
    if (values != nullptr && !by_code) {
      layer_pass.extra = values->data();
    }
    for (unsigned code = 0; code < layer_pass.stay.size(); ++code) {
      const bool is_free = (code & neighbour_bit({0, 0})) == 0;
      const bool may_leave = (code & neighbour_bit(step)) == 0;
      // With the factor in it, the weights stay near 1 in sum however many steps there are.
      const double weight = !is_free ? 0.0 : belief_.factor() * (by_code ? (*values)[code] : 1.0);
      layer_pass.stay[code] = weight * (may_leave ? 1.0 - shift.share : 1.0);
      layer_pass.come[code] = weight * shift.share;
    }
    total += layer_pass.run(belief_.layer(h), scratch_.layer(h), codes_,
                            step.x + step.y * belief_.stride(), stride, last);
  }
  if (!(total > least) || !std::isfinite(total)) {
    return 0.0;
  }
  scratch_.set_factor(1.0 / total);
  std::swap(belief_, scratch_);
  return total;
}

void BeliefFilter::predict(const Displacement& driven) {
  for (const Shift& shift : shifts(motion_->steps(driven, rng_))) {
    apply(shift, 0, nullptr, 0.0);
  }
  belief_.roll(driven.quarter_turns);
  summarise();
}

Correction BeliefFilter::correct(const LocalOccupancy& seen, double residual_yaw_rad,
                                 double weight) {
  const Likelihood& likelihood = measurement_->measure(seen, residual_yaw_rad, weight);
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
  belief_.roll(driven.quarter_turns);
  for (std::size_t i = 0; i + 1 < moves.size(); ++i) {
    apply(moves[i], driven.quarter_turns, nullptr, 0.0);
  }
  const Likelihood& likelihood =
      measurement_->measure(seen, residual_yaw(T_odom_robot), is_first ? 1.0 : news_in(driven));
  const double evidence =
      apply(moves.back(), driven.quarter_turns, &likelihood, params_.contradiction_evidence);
  if (evidence == 0.0) {
    apply(moves.back(), driven.quarter_turns, nullptr, 0.0);
  }
  return settle(evidence);
}

double BeliefFilter::news_in(const Displacement& driven) const {
  const double way_m = std::hypot(driven.forward_m, driven.left_m);
  return way_m >= params_.independence_m ? 1.0 : way_m / params_.independence_m;
}

Correction BeliefFilter::settle(double evidence) {
  Correction outcome = Correction::kApplied;
  if (evidence > 0.0) {
    contradictions_in_a_row_ = 0;
  } else {
    outcome = Correction::kContradiction;
    ++contradictions_;
    if (++contradictions_in_a_row_ >= params_.reopen_after) {
      contradictions_in_a_row_ = 0;
      outcome = Correction::kReopened;
      const Belief anywhere = Belief::uniform(map_);
      for (const Heading h : kHeadings) {
        for (std::size_t i = 0; i < belief_.padded_size(); ++i) {
          belief_.layer(h)[i] =
              (1.0 - params_.reopen_weight) * belief_.factor() * belief_.layer(h)[i] +
              params_.reopen_weight * anywhere.factor() * anywhere.layer(h)[i];
        }
      }
      belief_.normalise();
    }
  }
  summarise();
  return outcome;
}

void BeliefFilter::summarise() {
  double best = 0.0;
  for (const Heading h : kHeadings) {
    const std::vector<double>& layer = belief_.layer(h);
    best = std::max(best, *std::max_element(layer.begin(), layer.end()));
  }
  // Sums taken in another order differ in the last digits; such cells are equals.
  const double least = best * (1.0 - 1e-9);
  const auto weight_of = [&](const Estimate& e) {
    return belief_.layer(e.heading)[belief_.padded_index(e.cell)];
  };
  const bool is_still_best = belief_.contains(estimate_.cell) && weight_of(estimate_) >= least;
  if (!is_still_best) {
    std::vector<Estimate> equals;
    const auto stride = static_cast<std::size_t>(belief_.stride());
    for (const Heading h : kHeadings) {
      const std::vector<double>& layer = belief_.layer(h);
      for (std::size_t i = stride; i < layer.size() - stride; ++i) {
        if (layer[i] >= least && layer[i] > 0.0) {
          equals.push_back(
              {h, {static_cast<int>(i % stride) - 1, static_cast<int>(i / stride) - 1}});
        }
      }
    }
    estimate_ = equals[draw_index(rng_, equals.size())];
  }
  estimate_.probability = belief_(estimate_.heading, estimate_.cell);
  confidence_ = mass_near(belief_, estimate_, 1.0 / map_.resolution());
}

}  // namespace cmn
