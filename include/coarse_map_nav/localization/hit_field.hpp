// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The likelihood field of a drawing (Thrun et al. 2005, ch. 6), for look-ups by offset.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"

#include <cstddef>
#include <vector>

namespace cmn {

/// Per cell of the drawing, and of a margin about it: how well a hit fits there, and whether it is
/// occupied. A place about a cell is the cell's index plus an offset that is the same for all
/// cells.
class HitField {
 public:
  /// `margin_m`: the longest offset that will be asked for, in nominal metres of the drawing.
  /// `sigma_m` and `floor` as in log_hit().
  HitField(const CoarseMap& map, double margin_m, double sigma_m, double floor);

  std::ptrdiff_t index_of(Cell c) const {
    return static_cast<std::ptrdiff_t>(c.y + margin_) * stride_ + c.x + margin_;
  }
  std::ptrdiff_t offset_of(Cell by) const {
    return static_cast<std::ptrdiff_t>(by.y) * stride_ + by.x;
  }
  /// log(exp(-d^2 / 2 sigma^2) + floor), d from the middle of the cell to the nearest surface: the
  /// border of an occupied cell beside a free one. Deep within what is occupied nothing is hit.
  float log_hit(std::ptrdiff_t i) const { return log_hit_[static_cast<std::size_t>(i)]; }
  /// 0 or 1; all outside of the drawing is occupied.
  float occupied(std::ptrdiff_t i) const { return occupied_[static_cast<std::size_t>(i)]; }
  /// The same for the cells from `i` on. As many as the border is wide may be read past any place
  /// that an offset leads to.
  const float* log_hits_from(std::ptrdiff_t i) const { return log_hit_.data() + i; }
  const float* occupied_from(std::ptrdiff_t i) const { return occupied_.data() + i; }

 private:
  int margin_ = 0;  ///< [cells]
  int stride_ = 0;
  std::vector<float> log_hit_;
  std::vector<float> occupied_;
};

}  // namespace cmn
