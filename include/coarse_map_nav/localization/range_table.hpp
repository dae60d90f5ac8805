// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The range that the drawing makes one expect, from every cell in every direction.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/localization/ray_profile.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cmn {

/// log((range + offset) / offset) in equal steps of one byte: a factor of scale is a mere shift.
struct LogRange {
  double offset_m = 0.3;
  double longest_m = 16.0;

  double step() const;
  double exact(double range_m) const;  ///< in steps, not rounded
  std::uint8_t coded(double range_m) const;
};

/// Tabulated once per map: kBearings bytes for each cell that a robot may stand on, which are the
/// free ones and their neighbours (the middle of the robot may well be in a cell of which half is
/// occupied). Rays begin at the middle of the cell and leave it freely.
class RangeTable {
 public:
  RangeTable(const CoarseMap& map, const LogRange& code);

  /// Padded by one cell all around: the layout of a Belief's layer.
  bool may_stand(std::size_t padded_index) const { return row_of_[padded_index] >= 0; }
  const std::uint8_t* row(std::size_t padded_index) const {
    return codes_.data() +
           static_cast<std::size_t>(row_of_[padded_index]) * static_cast<std::size_t>(kBearings);
  }

 private:
  std::vector<std::int32_t> row_of_;
  std::vector<std::uint8_t> codes_;
};

}  // namespace cmn
