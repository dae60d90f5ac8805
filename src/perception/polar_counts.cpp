// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/polar_counts.hpp"

#include "coarse_map_nav/data/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace cmn {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kFewest = 3;  ///< points that are no noise, however few there are
/// Neighbours in a row whose ranges differ by more belong to different surfaces; a wall that is
/// seen at less than 2 deg in an image of 640 columns is lost with the blur.
constexpr float kEdge = 0.1F;
constexpr std::size_t kBlur = 2;  ///< [pixels] width of the blur at an edge
/// From the densest neighbourhood's way: more would climb up a slope.
constexpr std::size_t kMostClimbed = 2;

// The bits of a squared range, a float: exponent and the first four of the mantissa are its log
// range, 32 numbers a doubling of the range; the next twelve are where in it the range lies.
constexpr int kRestBits = 12;
constexpr int kRestShift = 7;
constexpr int kLogShift = kRestShift + kRestBits;
constexpr std::uint32_t kRestMask = (1U << kRestBits) - 1U;
/// Counts of what counts nowhere, in turn: additions to one wait for each other.
constexpr std::size_t kNone = 16;
constexpr int kCountShift = 38;  ///< of a Count, below which its rests are added up
constexpr std::uint64_t kOnePoint = std::uint64_t{1} << kCountShift;

std::uint32_t points_of(std::uint64_t count) {
  return static_cast<std::uint32_t>(count >> kCountShift);
}

std::int32_t bits_of(float value) {
  std::int32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

std::int32_t log_range_of(double range_m) {
  return bits_of(static_cast<float>(range_m * range_m)) >> kLogShift;
}

/// The range at which a log range begins, or, with `share`, after that share of it.
float range_from(std::int32_t log_range, float share = 0.0F) {
  const std::int32_t bits =
      (log_range << kLogShift) +
      static_cast<std::int32_t>(share * static_cast<float>(std::int32_t{1} << kLogShift));
  float square_m2 = 0.0F;
  std::memcpy(&square_m2, &bits, sizeof bits);
  return std::sqrt(square_m2);
}

/// atan2 to within 1e-4 rad, without branches, for the compiler to do several at once: the octants
/// are folded onto one another by signs. (Polynomial: Hastings 1955, sheet 11.) NaN for NaN.
float bearing_of(float x, float y) {
  constexpr auto kQuarter = static_cast<float>(kPi / 2.0);
  constexpr float kEighth = 0.5F * kQuarter;
  const float ax = std::abs(x);
  const float ay = std::abs(y);
  const float difference = std::abs(ax - ay);
  const float ratio = (ax + ay - difference) / (ax + ay + difference);
  const float s = ratio * ratio;
  const float angle =
      ratio * (0.999866F + s * (-0.3302995F + s * (0.180141F + s * (-0.085133F + s * 0.0208351F))));
  const float first = kEighth - std::copysign(kEighth - angle, ax - ay);
  const float upper = kQuarter - std::copysign(kQuarter - first, x);
  return std::copysign(upper, y);
}

}  // namespace

PolarCounts::PolarCounts(const DepthParams& params)
    : params_{params},
      // Bins 1 and on are those from the least range on; bin 0 and the last are of no range.
      nearest_{log_range_of(params.range_min_m)},
      range_bins_{static_cast<std::size_t>(log_range_of(params.range_max_m) - nearest_ + 3)},
      row_size_{2 * range_bins_},
      all_about_(range_bins_),
      in_way_about_(range_bins_) {}

void PolarCounts::begin(const RangeScan& layout) {
  beams_ = layout.ranges_m.size();
  counts_.resize((beams_ + 2) * row_size_ + kNone);
  rows_per_rad_ = static_cast<float>(1.0 / layout.angle_increment_rad);
  // Half a row more, for rounding, and one more, since there is one of no beam before the first.
  row_offset_ = 1.5F - static_cast<float>(layout.angle_min_rad) * rows_per_rad_;
}

void PolarCounts::add(const PointPiece& piece, DepthReport& report) {
  // Work arrays, with as much of nothing before and after as points are compared with.
  std::array<float, PointPiece::kMost + 2 * kBlur> square_m2;
  std::array<std::int32_t, PointPiece::kMost> row_start;
  const std::size_t count = piece.count;
  for (std::size_t i = 0; i < kBlur; ++i) {
    square_m2[i] = square_m2[kBlur + count + i] = kNan;
  }
  const float rows_per_rad = rows_per_rad_, row_offset = row_offset_;
  const auto last = static_cast<float>(beams_) + 1.0F;
  const auto slots_a_row = static_cast<float>(row_size_);
  for (std::size_t i = 0; i < count; ++i) {
    const float x = piece.x[i], y = piece.y[i];
    square_m2[kBlur + i] = x * x + y * y;
    const float bearing = row_offset + rows_per_rad * bearing_of(x, y);
    const float at_least = bearing > 1.0F ? bearing : 1.0F;  // of NaN, too
    const auto row = static_cast<std::int32_t>(at_least < last ? at_least : last);
    // Floats hold these numbers, and are quicker to multiply.
    row_start[i] = static_cast<std::int32_t>(static_cast<float>(row) * slots_a_row);
  }

  std::array<std::int32_t, PointPiece::kMost> slot;  // in twice as many as there are bins
  std::array<std::uint32_t, PointPiece::kMost> rest;
  const auto least_m2 = static_cast<float>(params_.range_min_m * params_.range_min_m);
  const auto lowest_m = static_cast<float>(params_.lowest_m);
  const auto highest_m = static_cast<float>(params_.highest_m);
  const auto first_none = static_cast<std::int32_t>(counts_.size() - kNone);
  const std::int32_t before_nearest = nearest_ - 1;
  const auto farthest = static_cast<std::int32_t>(range_bins_) - 2;
  // Nothing is infinitely farther than its neighbour, so that nothing of a loose cloud flies.
  const float gap = piece.is_row ? (1.0F + kEdge) * (1.0F + kEdge) : kInfinity;
  std::int32_t points = 0;
  std::int32_t flying = 0;
  // Without branches, too.
  for (std::size_t i = 0; i < count; ++i) {
    const float before = square_m2[i];
    const float here = square_m2[i + kBlur];
    const float after = square_m2[i + 2 * kBlur];
    const float height_m = piece.height_m[i];
    const std::int32_t bits = bits_of(here);
    const std::int32_t log_range = (bits >> kLogShift) - before_nearest;
    const unsigned is_point = unsigned{here >= least_m2} & unsigned{here < kInfinity};
    const unsigned is_in_band = unsigned{height_m > -lowest_m} & unsigned{height_m < highest_m};
    const unsigned is_in_way = unsigned{height_m > lowest_m} & unsigned{log_range <= farthest};
    const float farther = gap * here;
    const unsigned is_flying = (unsigned{here > gap * before} & unsigned{after > farther}) |
                               (unsigned{here > gap * after} & unsigned{before > farther});
    const std::int32_t own =
        row_start[i] + 2 * std::min(log_range, farthest) + static_cast<std::int32_t>(is_in_way);
    // One or the other, by a mask: of a choice the compiler makes a branch, and one at a time.
    const auto counts = static_cast<std::int32_t>(is_point & is_in_band & ~is_flying);
    const std::int32_t none = first_none + static_cast<std::int32_t>(i % kNone);
    slot[i] = none + ((own - none) & -counts);
    rest[i] = (static_cast<std::uint32_t>(bits) >> kRestShift) & kRestMask;
    points += static_cast<std::int32_t>(is_point);
    flying += static_cast<std::int32_t>(is_flying);
  }
  report.points += static_cast<std::size_t>(points);
  report.flying += static_cast<std::size_t>(flying);
  for (std::size_t i = 0; i < count; ++i) {
    counts_[static_cast<std::size_t>(slot[i])] += kOnePoint | rest[i];
  }
}

void PolarCounts::read_out(RangeScan& scan, DepthReport& report) {
  // All around, half a row before the first is beyond the last.
  Count* beyond = row_of(beams_ + 1);
  for (std::size_t i = 0; i < row_size_; ++i) {
    row_of(1)[i] += beyond[i];
    beyond[i] = 0;
  }
  std::size_t first = beams_;
  std::size_t last = 0;
  for (std::size_t beam = 0; beam < beams_; ++beam) {
    const Count* row = row_of(beam + 1);
    const std::uint32_t points = points_of(std::accumulate(row, row + row_size_, Count{0}));
    if (points > 0) {
      const auto enough = static_cast<std::uint32_t>(params_.least_share * points);
      read_out_beam(beam, std::max(kFewest, enough), scan, report);
      first = std::min(first, beam);
      last = beam;
    }
  }
  if (first <= last) {
    std::fill(row_of(first + 1), row_of(last + 2), Count{0});
  }
  std::fill(counts_.end() - kNone, counts_.end(), Count{0});
}

void PolarCounts::sum_about(std::size_t row) {
  const Count* before = row_of(row - 1);
  const Count* own = row_of(row);
  const Count* after = row_of(row + 1);
  for (std::size_t r = 0; r < range_bins_; ++r) {
    const Count low = before[2 * r] + own[2 * r] + after[2 * r];
    in_way_about_[r] = before[2 * r + 1] + own[2 * r + 1] + after[2 * r + 1];
    all_about_[r] = low + in_way_about_[r];
  }
}

void PolarCounts::read_out_beam(std::size_t beam, std::uint32_t enough, RangeScan& scan,
                                DepthReport& report) {
  sum_about(beam + 1);
  const Count* own = row_of(beam + 1);
  const auto obstacles = [&](std::size_t r) { return points_of(own[2 * r + 1]); };
  const auto has_enough = [&](const std::vector<Count>& about, std::size_t r) {
    return points_of(about[r - 1] + about[r] + about[r + 1]) >= enough;
  };
  RangeScan::Sight& sight = scan.sights[beam];
  bool has_seen = false;
  std::size_t hit = 0;
  for (std::size_t r = 1; r + 1 < range_bins_ && hit == 0; ++r) {
    if (own[2 * r] + own[2 * r + 1] == 0) {
      continue;
    }
    if (obstacles(r) > 0) {
      if (has_enough(in_way_about_, r)) {
        hit = r;
      } else {
        report.isolated += obstacles(r);
      }
    }
    if (hit == r || has_enough(all_about_, r)) {
      const float from_m = range_from(nearest_ + static_cast<std::int32_t>(r) - 1);
      sight.from_m = has_seen ? sight.from_m : from_m;
      sight.to_m = from_m;
      has_seen = true;
    }
  }
  if (hit != 0) {
    for (std::size_t climbed = 0;
         climbed < kMostClimbed && hit + 2 < range_bins_ && obstacles(hit + 1) > obstacles(hit);
         ++climbed) {
      ++hit;
    }
    scan.ranges_m[beam] = mean_range_m(own[2 * hit + 1], hit);
  } else if (has_seen) {
    scan.ranges_m[beam] = kInfinity;
  }
}

float PolarCounts::mean_range_m(Count count, std::size_t range_bin) const {
  const auto rests = static_cast<float>(count & (kOnePoint - 1U));
  const float mean_rest = rests / static_cast<float>(points_of(count)) + 0.5F;
  return range_from(nearest_ + static_cast<std::int32_t>(range_bin) - 1,
                    mean_rest / static_cast<float>(1 << kRestBits));
}

}  // namespace cmn
