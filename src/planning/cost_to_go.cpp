// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/cost_to_go.hpp"

#include "coarse_map_nav/data/whole_number.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cmn {
namespace {

constexpr float kNoWay = std::numeric_limits<float>::infinity();

}  // namespace

CostToGo::CostToGo(const CoarseMap& map, Cell goal)
    : goal_{goal}, cost_{map.width(), map.height(), kNoWay} {
  assert(map.is_free(goal));
  // An occupied border of one cell spares the search every check of the map's bounds.
  const Grid<std::uint8_t>& occupied = map.occupied();
  Grid<std::uint8_t> is_open{map.width() + 2, map.height() + 2, 0};
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    is_open(occupied.cell_at(i) + Cell{1, 1}) = occupied[i] == 0;
  }
  const auto stride = static_cast<std::ptrdiff_t>(is_open.width());
  const std::array<std::ptrdiff_t, 4> steps{1, stride, -1, -stride};

  std::vector<std::size_t> frontier{is_open.index_of(goal + Cell{1, 1})};
  std::vector<std::size_t> next;
  is_open[frontier.front()] = 0;
  for (float cost = 0.0F; !frontier.empty(); cost += 1.0F) {
    next.clear();
    for (const std::size_t i : frontier) {
      cost_(is_open.cell_at(i) - Cell{1, 1}) = cost;
      for (const std::ptrdiff_t step : steps) {
        const std::size_t j = i + static_cast<std::size_t>(step);
        if (is_open[j] != 0) {
          is_open[j] = 0;
          next.push_back(j);
        }
      }
    }
    frontier.swap(next);
  }
}

double CostToGo::operator()(Cell c) const {
  return cost_.contains(c) ? static_cast<double>(cost_(c)) : static_cast<double>(kNoWay);
}

bool CostToGo::is_reachable(Cell c) const { return std::isfinite((*this)(c)); }

double CostToGo::between_cells(Point2 p_cells) const {
  const Cell home{whole_below(p_cells.x), whole_below(p_cells.y)};
  if (!is_reachable(home)) {
    return static_cast<double>(kNoWay);
  }
  const Cell low{whole_below(p_cells.x - 0.5), whole_below(p_cells.y - 0.5)};
  double cost = 0.0;
  double weight = 0.0;
  for (const Cell step : {Cell{0, 0}, Cell{1, 0}, Cell{0, 1}, Cell{1, 1}}) {
    const Cell c = low + step;
    const double share =
        (1.0 - std::abs(p_cells.x - 0.5 - c.x)) * (1.0 - std::abs(p_cells.y - 0.5 - c.y));
    if (is_reachable(c)) {
      cost += share * (*this)(c);
      weight += share;
    }
  }
  return cost / weight;  // home is among the four, with a share of 1/4 at the least
}

std::optional<Heading> CostToGo::next_heading(Cell from, Heading heading) const {
  const double here = (*this)(from);
  if (!std::isfinite(here)) {
    return std::nullopt;
  }
  for (const int turn : {0, 1, -1, 2}) {
    const Heading towards = turned(heading, turn);
    if ((*this)(from + unit_step(towards)) < here) {
      return towards;
    }
  }
  return std::nullopt;
}

std::vector<Cell> CostToGo::path(Cell from, Heading heading) const {
  std::vector<Cell> cells;
  if (is_reachable(from)) {
    cells.push_back(from);
    while (const auto towards = next_heading(cells.back(), heading)) {
      heading = *towards;
      cells.push_back(cells.back() + unit_step(heading));
    }
  }
  return cells;
}

}  // namespace cmn
