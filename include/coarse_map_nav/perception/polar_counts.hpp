// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The points of a look, counted by bearing and log range: what DepthProjector tells obstacles by.
#pragma once

#include "coarse_map_nav/perception/depth_params.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cmn {

/// Points worked on at a time: few enough to stay in the cache. Each coordinate is an array of its
/// own, for the compiler to work on several points at once.
struct PointPiece {
  static constexpr std::size_t kMost = 1024;
  std::size_t count = 0;
  bool is_row = false;                  ///< of an image: neighbours here are neighbours there
  std::array<float, kMost> x{}, y{};    ///< [m] from the place on the floor under the camera
  std::array<float, kMost> height_m{};  ///< over the floor; x, y or it NaN: no reading
};

/// Counts the points of one look by bearing and log range (32 bins a doubling), and makes a scan of
/// the counts. Nothing is allocated from look to look of the same layout.
class PolarCounts {
 public:
  explicit PolarCounts(const DepthParams& params);

  /// Of a look that is to become a scan like `layout`.
  void begin(const RangeScan& layout);
  void add(const PointPiece& piece, DepthReport& report);
  /// Fills in ranges and sights, and forgets all points.
  void read_out(RangeScan& scan, DepthReport& report);

 private:
  /// How many points, and below them the sum of what is left of their log ranges: one addition a
  /// point. There is room for 67 million points.
  using Count = std::uint64_t;
  Count* row_of(std::size_t row) { return counts_.data() + row * row_size_; }
  /// Sums of a row and its two neighbours.
  void sum_about(std::size_t row);
  void read_out_beam(std::size_t beam, std::uint32_t enough, RangeScan& scan, DepthReport& report);
  float mean_range_m(Count count, std::size_t range_bin) const;

  DepthParams params_;
  std::int32_t nearest_;    ///< log range of the second bin of a row
  std::size_t range_bins_;  ///< a row
  std::size_t row_size_;    ///< for each range those that are not in the way, then those that are
  std::size_t beams_ = 0;
  float row_offset_ = 0.0F;  ///< row of the bearing 0
  float rows_per_rad_ = 0.0F;
  /// Rows by bearing, of which the first and the last are of no beam; then some for all the rest.
  /// All are 0 between looks.
  std::vector<Count> counts_;
  std::vector<Count> all_about_, in_way_about_;  ///< by range, see sum_about()
};

}  // namespace cmn
