// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/repaired_cost_to_go.hpp"

#include "coarse_map_nav/data/whole_number.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cmn {
namespace {

/// Between neighbours without a wall between them the cost differs by no more, even on a diagonal.
constexpr int kSlope = 2;
constexpr std::int32_t kUnknown = std::numeric_limits<std::int32_t>::max();

}  // namespace

RepairedCostToGo::RepairedCostToGo(const RepairedMap& map, Cell goal)
    : goal_{goal}, width_{map.width()}, height_{map.height()} {
  // Outside nothing is ever cheaper.
  parts_.assign(static_cast<std::size_t>(width_ + 2) * static_cast<std::size_t>(height_ + 2),
                Part{std::numeric_limits<std::int32_t>::min(), 0, Heading::kEast});
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      parts_[index_of({x, y})] = {kUnknown, static_cast<std::uint16_t>(map.cost({x, y})),
                                  Heading::kEast};
    }
  }
  buckets_.resize(static_cast<std::size_t>(map.dearest()) + 1);
  go_back_to(0);
}

void RepairedCostToGo::offer(std::uint32_t from, std::int32_t least) const {
  // Towards the goal one enters `from`: the price is that of this part, from all its sides.
  const std::int32_t cost = parts_[from].cost + parts_[from].price;
  if (cost < least) {
    return;
  }
  std::vector<std::uint32_t>& bucket = buckets_[static_cast<std::size_t>(cost) % buckets_.size()];
  for (const Heading h : kHeadings) {
    const std::uint32_t i = neighbour(from, h);
    Part& part = parts_[i];
    if (cost < part.cost) {
      part.cost = cost;
      part.towards = turned(h, 2);
      bucket.push_back(i);
      ++waiting_;
    }
  }
}

void RepairedCostToGo::search_to(std::int32_t cost) const {
  for (; searched_ <= cost && waiting_ > 0; ++searched_) {
    std::vector<std::uint32_t>& bucket =
        buckets_[static_cast<std::size_t>(searched_) % buckets_.size()];
    for (const std::uint32_t i : bucket) {
      if (parts_[i].cost == searched_) {
        searched_parts_.push_back(i);
        offer(i, searched_);
      }
    }
    waiting_ -= bucket.size();
    bucket.clear();
  }
}

void RepairedCostToGo::go_back_to(std::int32_t cost) {
  for (std::vector<std::uint32_t>& bucket : buckets_) {
    for (const std::uint32_t i : bucket) {
      const bool is_outdated = parts_[i].cost < searched_;  // a cheaper way was found since
      parts_[i].cost = is_outdated ? parts_[i].cost : kUnknown;
    }
    bucket.clear();
  }
  waiting_ = 0;
  while (!searched_parts_.empty() && parts_[searched_parts_.back()].cost >= cost) {
    parts_[searched_parts_.back()].cost = kUnknown;
    searched_parts_.pop_back();
  }
  searched_ = cost;
  if (cost == 0) {
    parts_[index_of(goal_)].cost = 0;
    buckets_[0].push_back(static_cast<std::uint32_t>(index_of(goal_)));
    waiting_ = 1;
    return;
  }
  // What had been offered by those that remain, in the same order.
  const std::int32_t farthest = cost - static_cast<std::int32_t>(buckets_.size());
  const auto first =
      std::lower_bound(searched_parts_.begin(), searched_parts_.end(), farthest,
                       [&](std::uint32_t i, std::int32_t bound) { return parts_[i].cost < bound; });
  for (auto i = first; i != searched_parts_.end(); ++i) {
    offer(*i, cost);
  }
}

bool RepairedCostToGo::matters(std::uint32_t changed, std::uint16_t price_before) const {
  const Part& here = parts_[changed];
  return std::any_of(kHeadings.begin(), kHeadings.end(), [&](Heading h) {
    const Part& beside = parts_[neighbour(changed, h)];
    const bool comes_through = beside.towards == turned(h, 2) && beside.cost > here.cost;
    return here.price < price_before ? here.cost + here.price <= beside.cost
                                     : here.price > price_before && comes_through;
  });
}

void RepairedCostToGo::change(const RepairedMap& map, const std::vector<Cell>& parts) {
  std::int32_t nearest = kUnknown;
  for (const Cell c : parts) {
    const auto i = static_cast<std::uint32_t>(index_of(c));
    const auto before = parts_[i].price;
    parts_[i].price = static_cast<std::uint16_t>(map.cost(c));
    if (parts_[i].cost < searched_ && matters(i, before)) {
      nearest = std::min(nearest, parts_[i].cost + std::min(before, parts_[i].price));
    }
  }
  if (nearest != kUnknown) {
    go_back_to(std::min(nearest, searched_));
  }
}

double RepairedCostToGo::operator()(Cell part) const {
  if (!contains(part)) {
    return kOutside;
  }
  const std::size_t i = index_of(part);
  while (parts_[i].cost > searched_) {
    search_to(searched_);
  }
  return static_cast<double>(parts_[i].cost);
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
    const auto there = static_cast<double>(parts_[index_of(part)].cost);
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
  return part + unit_step(parts_[index_of(part)].towards);
}

}  // namespace cmn
