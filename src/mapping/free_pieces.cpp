// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/free_pieces.hpp"

#include <algorithm>
#include <cmath>

namespace cmn {
namespace {

/// For each pixel along one side the cell that it falls into; the cells number `count`.
std::vector<int> cells_along(int pixels, double pixels_per_cell, int count) {
  std::vector<int> cells(static_cast<std::size_t>(pixels), count - 1);
  for (int cell = 0; cell < count; ++cell) {
    const long begin = std::lround(cell * pixels_per_cell);
    const long end = std::min<long>(std::lround((cell + 1) * pixels_per_cell), pixels);
    for (long pixel = begin; pixel < end; ++pixel) {
      cells[static_cast<std::size_t>(pixel)] = cell;
    }
  }
  return cells;
}

/// The number of cells along a side. A cell that would be covered by less than a tenth is left out,
/// and its pixels go to the one before.
int count_along(int pixels, double pixels_per_cell) {
  return std::max(1, static_cast<int>(std::ceil(pixels / pixels_per_cell - 0.1)));
}

double extent(int cell, double pixels_per_cell) {
  return static_cast<double>(std::lround((cell + 1) * pixels_per_cell) -
                             std::lround(cell * pixels_per_cell));
}

}  // namespace

FreePieces::FreePieces(const Grid<std::uint8_t>& occupied, double pixels_per_cell)
    : of_cell_{count_along(occupied.width(), pixels_per_cell),
               count_along(occupied.height(), pixels_per_cell)} {
  column_of_ = cells_along(occupied.width(), pixels_per_cell, width());
  row_of_ = cells_along(occupied.height(), pixels_per_cell, height());
  cut(occupied, pixels_per_cell);
  find_components();
}

void FreePieces::cut(const Grid<std::uint8_t>& occupied, double pixels_per_cell) {
  Grid<int> piece_of{occupied.width(), occupied.height(), -1};
  std::vector<Cell> front;
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    if (occupied[i] != 0 || piece_of[i] >= 0) {
      continue;
    }
    const Cell block = cell_of(occupied.cell_at(i));
    int area = 0;
    piece_of[i] = size();
    front.assign(1, occupied.cell_at(i));
    while (!front.empty()) {
      const Cell pixel = front.back();
      front.pop_back();
      ++area;
      for (const Heading h : kHeadings) {
        const Cell next = pixel + unit_step(h);
        if (occupied.contains(next) && occupied(next) == 0 && piece_of(next) < 0 &&
            cell_of(next) == block) {
          piece_of(next) = size();
          front.push_back(next);
        }
      }
    }
    of_cell_(block).push_back(size());
    pieces_.push_back({block,
                       area / (extent(block.x, pixels_per_cell) * extent(block.y, pixels_per_cell)),
                       -1,
                       {}});
  }
  for (std::vector<int>& cell : of_cell_.values()) {
    std::stable_sort(cell.begin(), cell.end(),
                     [&](int a, int b) { return (*this)[a].share > (*this)[b].share; });
  }
  link(piece_of);
}

void FreePieces::link(const Grid<int>& piece_of) {
  for (int y = 0; y < piece_of.height(); ++y) {
    for (int x = 0; x < piece_of.width(); ++x) {
      const int a = piece_of({x, y});
      for (const Cell step : {Cell{1, 0}, Cell{0, 1}}) {
        const Cell next = Cell{x, y} + step;
        const int b = piece_of.contains(next) ? piece_of(next) : -1;
        if (a >= 0 && b >= 0 && a != b) {
          pieces_[static_cast<std::size_t>(a)].links.push_back(b);
          pieces_[static_cast<std::size_t>(b)].links.push_back(a);
        }
      }
    }
  }
  for (FreePiece& piece : pieces_) {
    std::sort(piece.links.begin(), piece.links.end());
    piece.links.erase(std::unique(piece.links.begin(), piece.links.end()), piece.links.end());
  }
}

void FreePieces::find_components() {
  std::vector<int> front;
  for (int start = 0; start < size(); ++start) {
    if (pieces_[static_cast<std::size_t>(start)].component >= 0) {
      continue;
    }
    front.assign(1, start);
    pieces_[static_cast<std::size_t>(start)].component = component_count_;
    while (!front.empty()) {
      const int piece = front.back();
      front.pop_back();
      for (const int next : (*this)[piece].links) {
        if ((*this)[next].component < 0) {
          pieces_[static_cast<std::size_t>(next)].component = component_count_;
          front.push_back(next);
        }
      }
    }
    ++component_count_;
  }
}

bool FreePieces::joined(int a, int b) const {
  if (std::binary_search((*this)[a].links.begin(), (*this)[a].links.end(), b)) {
    return true;
  }
  std::vector<int> reached{a};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (const int next : (*this)[reached[i]].links) {
      const Cell cell = (*this)[next].cell;
      if ((cell == (*this)[a].cell || cell == (*this)[b].cell) &&
          std::find(reached.begin(), reached.end(), next) == reached.end()) {
        reached.push_back(next);
      }
    }
  }
  return std::find(reached.begin(), reached.end(), b) != reached.end();
}

}  // namespace cmn
