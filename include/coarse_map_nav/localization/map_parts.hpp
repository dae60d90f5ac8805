// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A drawing whose cells are cut into parts.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cmn {

/// The hypotheses of a ScaleFilter stand in the middles of parts. In maps too large for that a part
/// is a cell.
class MapParts {
 public:
  /// Parts of at most `part_m` a side, but larger ones where those were more than `most_parts` of
  /// free ground.
  MapParts(const CoarseMap& drawing, double part_m, double most_parts);

  int cuts() const { return cuts_; }  ///< of a cell, either way
  /// The drawing in parts.
  const CoarseMap& map() const { return map_; }

  /// Padded by one part all around: the layout of a Belief's layer over map().
  int stride() const { return map_.width() + 2; }
  std::size_t padded_size() const {
    return static_cast<std::size_t>(stride()) * static_cast<std::size_t>(map_.height() + 2);
  }
  std::size_t padded_index(Cell part) const {
    return static_cast<std::size_t>(part.y + 1) * static_cast<std::size_t>(stride()) +
           static_cast<std::size_t>(part.x + 1);
  }
  Cell part_of(std::uint32_t padded_index) const {
    // Half an index keeps the product off whole numbers: nothing is rounded over one.
    const int row = static_cast<int>((padded_index + 0.5) * per_stride_);
    return {static_cast<int>(padded_index) - row * stride() - 1, row - 1};
  }
  /// The cell of the drawing that a part of it belongs to.
  Cell cell_of(Cell part) const { return {part.x / cuts_, part.y / cuts_}; }
  /// Those of a cell of the drawing.
  std::vector<Cell> parts_in(Cell cell) const;
  /// Those whose middles lie within a distance of the middle of a cell of the drawing.
  std::vector<Cell> parts_near(Cell cell, double radius_m) const;

 private:
  int cuts_;
  CoarseMap map_;
  double per_stride_;
};

}  // namespace cmn
