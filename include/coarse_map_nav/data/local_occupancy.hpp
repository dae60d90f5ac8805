// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the robot sees around itself: the observation of every filter in this package.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace cmn {

/// The sensor that an observation comes from; values as in msg/LocalOccupancy.
enum class ObservationSource : std::uint8_t { kUnknown = 0, kLidar, kDepth, kRgb, kFused };

/// The confidence of ground that nobody saw but that is taken to be free: too near to a camera to
/// be in its view. It never outweighs what was seen.
constexpr float kPresumed = 0.1F;

/// By how much odometry's heading has drifted to the left, as looks tell that were aligned with
/// each other.
struct HeadingDrift {
  double rad = 0.0;
  double since_s = 0.0;  ///< time of the first of them; drifts of two beginnings do not compare
};

/// A square grid of occupancy about the robot, axes as base_link: x forward, y left.
///
/// Cell (ix, iy) covers x in [(ix - size/2) r, (ix + 1 - size/2) r) and y likewise: the robot
/// stands in the middle of the square. Stored with ix running fastest.
/// `occupancy` is P(occupied) in [0, 1]; `confidence` >= 0 weighs it, 0 where nothing is known.
struct LocalOccupancy {
  double stamp_s = 0.0;     ///< time of the newest data in it
  double resolution = 0.0;  ///< [m/cell]
  int size = 0;             ///< cells per side
  std::vector<float> occupancy;
  std::vector<float> confidence;
  ObservationSource source = ObservationSource::kUnknown;
  std::optional<HeadingDrift> heading_drift;  ///< none where looks are not aligned

  LocalOccupancy() = default;
  /// Nothing known anywhere: occupancy 0.5, confidence 0.
  LocalOccupancy(int size_cells, double resolution_m)
      : resolution{resolution_m},
        size{size_cells},
        occupancy(cell_count(), 0.5F),
        confidence(cell_count(), 0.0F) {}

  std::size_t cell_count() const {
    return static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  }
  std::size_t index_of(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(size) +
           static_cast<std::size_t>(ix);
  }
  double side_m() const { return size * resolution; }
};

/// Where ground that was seen to be free ends at something: the middles of occupied cells beside a
/// free one, in the robot's frame [m].
std::vector<Point2> surface_of(const LocalOccupancy& seen);

}  // namespace cmn
