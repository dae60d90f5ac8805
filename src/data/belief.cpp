// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/data/belief.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cmn {

Belief Belief::uniform(const CoarseMap& map) {
  Belief belief{map.width(), map.height()};
  for (std::size_t i = 0; i < map.occupied().size(); ++i) {
    if (map.occupied()[i] == 0) {
      for (const Heading h : kHeadings) {
        belief.set_weight(h, map.occupied().cell_at(i), 1.0);
      }
    }
  }
  belief.normalise();
  return belief;
}

bool Belief::normalise() {
  double total = 0.0;
  for (const auto& layer : layers_) {
    for (const double weight : layer) {
      total += weight;
    }
  }
  if (!std::isfinite(total) || total <= 0.0) {
    return false;
  }
  factor_ = 1.0 / total;
  return true;
}

void Belief::roll(int quarter_turns) {
  const int q = ((quarter_turns % 4) + 4) % 4;
  std::rotate(layers_.begin(), layers_.end() - q, layers_.end());
}

Grid<double> marginal(const Belief& belief) {
  Grid<double> sum{belief.width(), belief.height()};
  for (std::size_t i = 0; i < sum.size(); ++i) {
    for (const Heading h : kHeadings) {
      sum[i] += belief(h, sum.cell_at(i));
    }
  }
  return sum;
}

double entropy(const Belief& belief) {
  double sum = 0.0;
  for (const Heading h : kHeadings) {
    for (const double weight : belief.layer(h)) {
      const double p = belief.factor() * weight;
      sum -= p > 0.0 ? p * std::log(p) : 0.0;
    }
  }
  return sum;
}

double mass_near(const Belief& belief, const Estimate& estimate, double radius_cells) {
  const int reach = static_cast<int>(std::floor(radius_cells));
  double mass = 0.0;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell c = estimate.cell + Cell{dx, dy};
      if (dx * dx + dy * dy <= radius_cells * radius_cells && belief.contains(c)) {
        mass += belief(estimate.heading, c);
      }
    }
  }
  return mass;
}

}  // namespace cmn
