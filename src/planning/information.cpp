// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/information.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <utility>

namespace cmn {
namespace {

/// What is lost where one of a pair is taken for the other [m], of the pairs (0, 1), (0, 2), ...
std::vector<double> losses_m(const Prospects& prospects) {
  const std::vector<std::vector<double>>& costs = prospects.costs_m;
  std::vector<std::size_t> best;
  for (const std::vector<double>& of_places : costs) {
    best.push_back(static_cast<std::size_t>(
        std::distance(of_places.begin(), std::min_element(of_places.begin(), of_places.end()))));
  }
  std::vector<double> losses;
  for (std::size_t i = 0; i < best.size(); ++i) {
    for (std::size_t j = i + 1; j < best.size(); ++j) {
      const double more =
          costs[i][best[j]] - costs[i][best[i]] + costs[j][best[i]] - costs[j][best[j]];
      losses.push_back(prospects.hypotheses[i].weight * prospects.hypotheses[j].weight * more);
    }
  }
  return losses;
}

/// What looks tell at a place, for each pair [nats a metre].
std::vector<double> apart_at(const Prospects& prospects, const ExpectedLooks& looks,
                             Point2 place_m) {
  std::vector<GridPose> poses;
  for (const Hypothesis& h : prospects.hypotheses) {
    poses.push_back(
        {h.pose.position_cells + turned(prospects.cells_per_m * place_m, h.pose.yaw_rad),
         h.pose.yaw_rad});
  }
  return looks.apart(poses, prospects.scale);
}

/// Of the places, along an axis [steps].
int farthest(const LocalLattice& lattice) {
  int steps = 0;
  for (const std::size_t i : lattice.places()) {
    const Cell offset = lattice.states()[i].offset;
    steps = std::max({steps, std::abs(offset.x), std::abs(offset.y)});
  }
  return steps;
}

}  // namespace

std::vector<Hypothesis> distinct(std::vector<Hypothesis> hypotheses, double apart_cells,
                                 std::size_t most) {
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.weight > b.weight; });
  std::vector<Hypothesis> found;
  for (const Hypothesis& h : hypotheses) {
    const auto same = std::find_if(found.begin(), found.end(), [&](const Hypothesis& other) {
      return norm(h.pose.position_cells - other.pose.position_cells) <= apart_cells &&
             std::abs(wrap_angle(h.pose.yaw_rad - other.pose.yaw_rad)) < kPi / 4.0;
    });
    if (same != found.end()) {
      same->weight += h.weight;
    } else if (found.size() < most) {
      found.push_back(h);
    }
  }
  return found;
}

std::vector<double> savings_m(const Prospects& prospects, const ExpectedLooks& looks) {
  const LocalLattice& lattice = prospects.lattice;
  const std::vector<LatticeState>& states = lattice.states();
  const std::vector<std::size_t>& places = lattice.places();
  std::vector<double> savings(places.size(), 0.0);
  const std::vector<double> losses = losses_m(prospects);
  if (std::all_of(losses.begin(), losses.end(), [](double loss) { return loss <= 0.0; })) {
    return savings;  // all want to go the same way
  }
  const int side = 2 * farthest(lattice) + 1;
  std::vector<std::size_t> place_at(static_cast<std::size_t>(side * side));
  const auto index_of = [side](Cell offset) {
    return static_cast<std::size_t>((offset.y + side / 2) * side + offset.x + side / 2);
  };
  const std::vector<double> here = apart_at(prospects, looks, {});
  std::vector<std::vector<double>> told(places.size());  // all the way there, of each pair [nats]
  told.front().assign(losses.size(), 0.0);
  place_at[index_of({0, 0})] = 0;
  for (std::size_t k = 1; k < places.size(); ++k) {
    const LatticeState& state = states[places[k]];
    place_at[index_of(state.offset)] = k;
    told[k] = told[place_at[index_of(states[static_cast<std::size_t>(state.parent)].offset)]];
    const std::vector<double> there = apart_at(prospects, looks, lattice.position_of(state));
    const double way_m = lattice.step_m() * prospects.newness[k];
    for (std::size_t pair = 0; pair < losses.size(); ++pair) {
      told[k][pair] += way_m * std::max(0.0, there[pair] - here[pair]);
      savings[k] += losses[pair] * (1.0 - std::exp(-told[k][pair]));
    }
  }
  return savings;
}

}  // namespace cmn
