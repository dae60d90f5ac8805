// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/data/belief.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
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

std::vector<Estimate> best_hypotheses(const Belief& belief, std::size_t count,
                                      int separation_cells) {
  std::vector<Estimate> all;
  for (const Heading h : kHeadings) {
    for (int y = 0; y < belief.height(); ++y) {
      for (int x = 0; x < belief.width(); ++x) {
        const double p = belief(h, {x, y});
        if (p > 0.0) {
          all.push_back({h, {x, y}, p});
        }
      }
    }
  }
  std::sort(all.begin(), all.end(),
            [](const Estimate& a, const Estimate& b) { return a.probability > b.probability; });
  std::vector<Estimate> best;
  for (const Estimate& candidate : all) {
    if (best.size() == count) {
      break;
    }
    const bool is_shadowed = std::any_of(best.begin(), best.end(), [&](const Estimate& better) {
      const Cell d = candidate.cell - better.cell;
      return candidate.heading == better.heading && std::abs(d.x) <= separation_cells &&
             std::abs(d.y) <= separation_cells;
    });
    if (!is_shadowed) {
      best.push_back(candidate);
    }
  }
  return best;
}

Spread spread_about(const Belief& belief, const Estimate& estimate) {
  Spread spread;
  for (const Heading h : kHeadings) {
    const double off_yaw = wrap_angle(yaw(h) - yaw(estimate.heading));
    for (int y = 0; y < belief.height(); ++y) {
      for (int x = 0; x < belief.width(); ++x) {
        const double p = belief(h, {x, y});
        const Cell d = Cell{x, y} - estimate.cell;
        spread.xx += p * d.x * d.x;
        spread.xy += p * d.x * d.y;
        spread.yy += p * d.y * d.y;
        spread.yaw += p * off_yaw * off_yaw;
      }
    }
  }
  return spread;
}

}  // namespace cmn
