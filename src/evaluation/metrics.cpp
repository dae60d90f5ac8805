// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/metrics.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <random>

namespace cmn {
namespace {

/// Stands for an action that never came.
constexpr double kLater = 1e9;
constexpr double kNormal975 = 1.959963984540054;  ///< 97.5 % of a normal variable lie below it

/// NaN for none.
double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Adds `value` unless it is NaN.
void add_number(std::vector<double>& values, double value) {
  if (!std::isnan(value)) {
    values.push_back(value);
  }
}

/// Quantile of sorted values, linear between neighbours.
double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto i = static_cast<std::size_t>(at);
  const std::size_t next = std::min(i + 1, sorted.size() - 1);
  return sorted[i] + (at - static_cast<double>(i)) * (sorted[next] - sorted[i]);
}

/// P(at most `k` heads in `n` fair tosses).
double fair_tail(int k, int n) {
  double tail = 0.0;
  for (int i = 0; i <= k; ++i) {
    tail += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) -
                     n * std::log(2.0));
  }
  return tail;
}

}  // namespace

Figure wilson_share(int successes, int trials) {
  assert(successes >= 0 && successes <= trials);
  if (trials == 0) {
    return {};
  }
  const double n = trials;
  const double p = successes / n;
  const double z2 = kNormal975 * kNormal975;
  const double middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half =
      kNormal975 * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n)) / (1.0 + z2 / n);
  // At the ends the formula gives exactly 0 and 1; rounding must not carry it beyond.
  return {p, successes == 0 ? 0.0 : middle - half, successes == trials ? 1.0 : middle + half};
}

Figure paired_difference(int both, int only_first, int only_second, int neither) {
  const int trials = both + only_first + only_second + neither;
  if (trials == 0) {
    return {};
  }
  const double n = trials;
  const Figure first = wilson_share(both + only_first, trials);
  const Figure second = wilson_share(both + only_second, trials);
  // How the two go together, with a continuity correction where they do.
  const double margins = static_cast<double>(both + only_first) * (only_second + neither) *
                         static_cast<double>(both + only_second) * (only_first + neither);
  const double product =
      static_cast<double>(both) * neither - static_cast<double>(only_first) * only_second;
  const double corrected = product > 0.0 ? std::max(0.0, product - n / 2.0) : product;
  const double phi = margins > 0.0 ? corrected / std::sqrt(margins) : 0.0;
  const auto span = [phi](double a, double b) {
    return std::sqrt(std::max(0.0, a * a - 2.0 * phi * a * b + b * b));
  };
  const double difference = first.value - second.value;
  return {difference, difference - span(first.value - first.low, second.high - second.value),
          difference + span(first.high - first.value, second.value - second.low)};
}

Figure bootstrap_mean(std::vector<double> values, std::uint64_t seed, int resamples) {
  assert(resamples > 0);
  if (values.empty()) {
    return {};
  }
  std::sort(values.begin(), values.end());
  std::mt19937_64 rng{seed};
  std::vector<double> means(static_cast<std::size_t>(resamples));
  for (double& resampled : means) {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum += values[draw_index(rng, values.size())];
    }
    resampled = sum / static_cast<double>(values.size());
  }
  std::sort(means.begin(), means.end());
  return {mean(values), quantile(means, 0.025), quantile(means, 0.975)};
}

double median(std::vector<double> values) {
  if (values.empty()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  std::sort(values.begin(), values.end());
  return quantile(values, 0.5);
}

Metrics metrics_of(const std::vector<EpisodeRow>& rows) {
  Metrics metrics;
  int successes = 0;
  int right = 0;
  int wrong = 0;
  int false_convergences = 0;
  int collisions = 0;
  double driven_m = 0.0;
  double actions = 0.0;
  double time_ms = 0.0;
  double pivots = 0.0;
  double simulated_s = 0.0;
  std::vector<double> free_iou;
  std::vector<double> obstacle_iou;
  int recoveries = 0;
  std::vector<double> recovered_actions;
  std::vector<double> spl;
  std::vector<double> converged_actions;
  std::vector<double> converged_driven_m;
  for (const EpisodeRow& row : rows) {
    successes += row.is_success;
    right += row.is_declared && row.is_declared_right;
    wrong += row.is_declared && !row.is_declared_right;
    collisions += row.collisions;
    driven_m += row.driven_m;
    actions += row.actions;
    time_ms += row.actions * row.step_ms;
    pivots += row.pivots;
    simulated_s += row.simulated_s;
    add_number(free_iou, row.free_iou);
    add_number(obstacle_iou, row.obstacle_iou);
    spl.push_back(row.spl());
    if (row.drop_actions >= 0) {
      recoveries += row.recovered_actions >= 0;
      recovered_actions.push_back(row.recovered_actions >= 0 ? row.recovered_actions : kLater);
    }
    if (row.converged_actions >= 0) {
      false_convergences += row.is_falsely_converged;
      converged_actions.push_back(row.converged_actions);
      converged_driven_m.push_back(row.converged_driven_m);
    }
  }
  const auto n = static_cast<int>(rows.size());
  const auto converged = static_cast<int>(converged_actions.size());
  metrics.episodes = n;
  metrics.success = wilson_share(successes, n);
  metrics.spl = bootstrap_mean(std::move(spl));
  metrics.declared_right = wilson_share(right, n);
  metrics.declared_wrong = wilson_share(wrong, n);
  metrics.converged = wilson_share(converged, n);
  metrics.falsely_converged = wilson_share(false_convergences, converged);
  metrics.median_converged_actions = median(std::move(converged_actions));
  metrics.median_converged_driven_m = median(std::move(converged_driven_m));
  metrics.kidnapped = static_cast<int>(recovered_actions.size());
  metrics.recovered = wilson_share(recoveries, metrics.kidnapped);
  const double middle = median(std::move(recovered_actions));
  if (middle < 0.5 * kLater) {
    metrics.median_recovered_actions = middle;
  }
  if (driven_m > 0.0) {
    metrics.collisions_per_100_m = 100.0 * collisions / driven_m;
  }
  if (n > 0) {
    metrics.mean_actions = actions / n;
    metrics.mean_pivots = pivots / n;
    metrics.mean_simulated_s = simulated_s / n;
  }
  metrics.free_iou = mean(free_iou);
  metrics.obstacle_iou = mean(obstacle_iou);
  if (actions > 0.0) {
    metrics.step_ms = time_ms / actions;
  }
  return metrics;
}

PairedSuccess paired_success(const std::vector<EpisodeRow>& first,
                             const std::vector<EpisodeRow>& second) {
  const auto without_method = [](EpisodeKey key) {
    key.method.clear();
    return key;
  };
  std::map<EpisodeKey, const EpisodeRow*> others;
  for (const EpisodeRow& row : second) {
    others[without_method(row.key)] = &row;
  }
  PairedSuccess pairs;
  std::vector<double> spl;
  for (const EpisodeRow& row : first) {
    const auto found = others.find(without_method(row.key));
    if (found != others.end()) {
      const EpisodeRow& other = *found->second;
      ++pairs.episodes;
      pairs.only_first += row.is_success && !other.is_success;
      pairs.only_second += !row.is_success && other.is_success;
      pairs.both += row.is_success && other.is_success;
      spl.push_back(row.spl() - other.spl());
    }
  }
  const int n = pairs.only_first + pairs.only_second;
  pairs.p_value = std::min(1.0, 2.0 * fair_tail(std::min(pairs.only_first, pairs.only_second), n));
  pairs.difference = paired_difference(pairs.both, pairs.only_first, pairs.only_second,
                                       pairs.episodes - pairs.both - n);
  pairs.spl_difference = bootstrap_mean(std::move(spl));
  return pairs;
}

}  // namespace cmn
