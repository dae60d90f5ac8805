// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/repaired_cost_to_go.hpp"

#include "coarse_map_nav/data/whole_number.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cmn {
namespace {

/// Between neighbours without a wall between them the cost differs by no more, even on a diagonal.
constexpr int kSlope = 2;
/// Of the border: nothing is ever cheaper.
constexpr std::int32_t kBorder = -1;

}  // namespace

RepairedCostToGo::RepairedCostToGo(const RepairedMap& map, Cell goal)
    : goal_{goal}, width_{map.width()}, height_{map.height()} {
  cost_.assign(static_cast<std::size_t>(width_ + 2) * static_cast<std::size_t>(height_ + 2),
               kBorder);
  price_.assign(cost_.size(), 0);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      cost_[index_of({x, y})] = kUnknown;
      price_[index_of({x, y})] = price_of(map, {x, y});
    }
  }
  cost_[index_of(goal_)] = 0;
  wait(static_cast<std::uint32_t>(index_of(goal_)));
}

void RepairedCostToGo::wait(std::uint32_t i) const {
  const std::int32_t cost = cost_[i];
  if (static_cast<std::size_t>(cost) >= waiting_.size()) {
    waiting_.resize(static_cast<std::size_t>(cost) + 1);
  }
  waiting_[static_cast<std::size_t>(cost)].push_back(i);
  searched_ = std::min(searched_, cost);
}

std::int32_t RepairedCostToGo::cost_through_nearer(std::uint32_t i, std::int32_t cost) const {
  std::int32_t least = kUnknown;
  for (const Heading h : kHeadings) {
    // Towards the goal one enters the neighbour: the price is that of it, from all its sides.
    const std::uint32_t j = neighbour(i, h);
    if (cost_[j] < cost && cost_[j] != kBorder) {
      least = std::min(least, cost_[j] + price_[j]);
    }
  }
  return least;
}

void RepairedCostToGo::offer(std::uint32_t from) const {
  const std::int32_t cost = cost_[from] + price_[from];
  for (const Heading h : kHeadings) {
    const std::uint32_t i = neighbour(from, h);
    if (cost < cost_[i]) {
      cost_[i] = cost;
      wait(i);
    }
  }
}

void RepairedCostToGo::lose_way(std::uint32_t i, std::int32_t instead) const {
  const std::int32_t before = std::exchange(cost_[i], instead);
  if (instead != kUnknown) {
    wait(i);
  }
  for (const Heading h : kHeadings) {
    const std::uint32_t j = neighbour(i, h);
    // They may have come through here, or may now be the best way from here.
    if (cost_[j] >= before && cost_[j] != kUnknown) {
      wait(j);
    }
  }
}

void RepairedCostToGo::search_to(std::int32_t cost) const {
  const auto goal = static_cast<std::uint32_t>(index_of(goal_));
  for (; searched_ <= cost && static_cast<std::size_t>(searched_) < waiting_.size(); ++searched_) {
    const auto here = static_cast<std::size_t>(searched_);
    // Others may be found to cost as much meanwhile, and offers make the row of buckets grow.
    for (std::size_t k = 0; k < waiting_[here].size(); ++k) {
      const std::uint32_t i = waiting_[here][k];
      if (cost_[i] != searched_) {
        continue;
      }
      const std::int32_t least = i == goal ? 0 : cost_through_nearer(i, searched_);
      if (least > searched_) {
        lose_way(i, least);
      } else {
        offer(i);
      }
    }
    std::vector<std::uint32_t>{}.swap(waiting_[here]);
  }
}

void RepairedCostToGo::change(const RepairedMap& map, const std::vector<Cell>& parts) {
  for (const Cell c : parts) {
    const auto i = static_cast<std::uint32_t>(index_of(c));
    price_[i] = price_of(map, c);
    if (cost_[i] == kUnknown) {
      continue;  // no way comes through here
    }
    // Cheaper: it has something to offer; dearer: who comes through here looks for a better way.
    wait(i);
    for (const Heading h : kHeadings) {
      const std::uint32_t j = neighbour(i, h);
      if (cost_[j] > cost_[i] && cost_[j] != kUnknown) {
        wait(j);
      }
    }
  }
}

double RepairedCostToGo::operator()(Cell part) const {
  if (!contains(part)) {
    return kOutside;
  }
  const std::size_t i = index_of(part);
  while (cost_[i] >= searched_) {
    search_to(searched_);
  }
  return static_cast<double>(cost_[i]);
}

double RepairedCostToGo::between(Point2 p_parts) const {
  const Cell home{whole_below(p_parts.x), whole_below(p_parts.y)};
  const double here = (*this)(home);
  if (here == kOutside) {
    return here;
  }
  search_to(static_cast<std::int32_t>(here) + kSlope);
  const Cell low{whole_below(p_parts.x - 0.5), whole_below(p_parts.y - 0.5)};
  double cost = 0.0;
  double weight = 0.0;
  for (const Cell step : {Cell{0, 0}, Cell{1, 0}, Cell{0, 1}, Cell{1, 1}}) {
    const Cell part = low + step;
    const auto there = static_cast<double>(cost_[index_of(part)]);
    if (std::abs(there - here) <= kSlope) {
      const double share =
          (1.0 - std::abs(p_parts.x - 0.5 - part.x)) * (1.0 - std::abs(p_parts.y - 0.5 - part.y));
      cost += share * there;
      weight += share;
    }
  }
  return cost / weight;  // home is among the four, with a share of 1/4 at the least
}

std::optional<Cell> RepairedCostToGo::next(Cell part) const {
  // Not the neighbour of the least cost: a wall beside costs little once one is in it.
  if (part == goal_ || (*this)(part) == kOutside) {
    return std::nullopt;
  }
  const auto i = static_cast<std::uint32_t>(index_of(part));
  const Heading* towards = std::find_if(kHeadings.begin(), kHeadings.end(), [&](Heading h) {
    const std::uint32_t j = neighbour(i, h);
    return cost_[j] != kBorder && cost_[j] < cost_[i] && cost_[j] + price_[j] == cost_[i];
  });
  return part + unit_step(*towards);
}

}  // namespace cmn
