// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/panorama.hpp"

#include "coarse_map_nav/data/whole_number.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace cmn {
namespace {

/// Lays `other` under what is `known`: it shows through where it is more confident.
void lay_under(LocalOccupancy& known, const LocalOccupancy& other, const Pose2& T_other_known) {
  const double half = 0.5 * known.size;
  // In cells of the other, along known's axes.
  const Point2 along_x = turned(Point2{1.0, 0.0}, T_other_known.yaw);
  const Point2 along_y{-along_x.y, along_x.x};
  const Point2 middle = (1.0 / known.resolution) * T_other_known.position() + Point2{half, half};
  for (int iy = 0; iy < known.size; ++iy) {
    for (int ix = 0; ix < known.size; ++ix) {
      const Point2 p = middle + (ix + 0.5 - half) * along_x + (iy + 0.5 - half) * along_y;
      const int other_x = whole_below(p.x);
      const int other_y = whole_below(p.y);
      if (other_x < 0 || other_y < 0 || other_x >= other.size || other_y >= other.size) {
        continue;
      }
      const std::size_t from = other.index_of(other_x, other_y);
      const std::size_t to = known.index_of(ix, iy);
      const bool is_behind = known.confidence[to] == 0.0F && other.occupancy[from] > 0.5F;
      if (other.confidence[from] > known.confidence[to] || is_behind) {
        known.confidence[to] = other.confidence[from];
        known.occupancy[to] = other.occupancy[from];
      }
    }
  }
}

}  // namespace

void fill_corners(LocalOccupancy& seen, const PanoramaParams& params) {
  const double half = 0.5 * std::min(params.corner_side_m / seen.resolution, 1.0 * seen.size);
  const auto cell_at = [&](double from_middle) {
    return static_cast<int>(std::lround(0.5 * seen.size + from_middle));
  };
  const std::array<std::array<int, 2>, 2> sides{
      {{cell_at(-half), cell_at(-half / 3.0)}, {cell_at(half / 3.0), cell_at(half)}}};
  for (const auto& rows : sides) {
    for (const auto& columns : sides) {
      const auto for_each = [&](auto&& visit) {
        for (int iy = rows[0]; iy < rows[1]; ++iy) {
          for (int ix = columns[0]; ix < columns[1]; ++ix) {
            visit(seen.index_of(ix, iy));
          }
        }
      };
      int cells = 0;
      int occupied = 0;
      for_each([&](std::size_t i) {
        ++cells;
        occupied += seen.occupancy[i] > 0.5F;
      });
      if (occupied > params.corner_share * cells) {
        for_each([&](std::size_t i) {
          seen.occupancy[i] = 1.0F;
          seen.confidence[i] = std::max(seen.confidence[i], 1.0F);
        });
      }
    }
  }
}

LocalOccupancy Panorama::fuse(LocalOccupancy look, const Pose2& T_odom_robot) {
  around_.add(look, T_odom_robot);
  for (const auto& other : around_.looks()) {
    lay_under(look, other.seen, inverse(other.T_odom_robot) * T_odom_robot);
  }
  if (is_complete() && params_.corner_share < 1.0) {
    fill_corners(look, params_);
  }
  return look;
}

}  // namespace cmn
