// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/range_table.hpp"

#include "coarse_map_nav/data/belief.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "ascii_map.hpp"
#include "random_case.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

std::size_t padded(const CoarseMap& map, Cell c) {
  return Belief{map.width(), map.height()}.padded_index(c);
}

int expected_code(const CoarseMap& map, const LogRange& code, Cell c, int b) {
  return RangeTable{map, code}.row(padded(map, c))[b];
}

/// Where a ray from the origin enters the unit square of a cell; infinite when it does not.
double entry(Point2 origin, Point2 ahead, Cell c) {
  double in = 0.0;
  double out = std::numeric_limits<double>::infinity();
  const auto cut = [&](double from, double slope, double low) {
    if (std::abs(slope) < 1e-12) {
      out = from > low && from < low + 1.0 ? out : -1.0;
      return;
    }
    const double a = (low - from) / slope;
    const double b = (low + 1.0 - from) / slope;
    in = std::max(in, std::min(a, b));
    out = std::min(out, std::max(a, b));
  };
  cut(origin.x, ahead.x, c.x);
  cut(origin.y, ahead.y, c.y);
  return in < out ? in : std::numeric_limits<double>::infinity();
}

/// Tries every occupied cell, and those around the map.
double brute_force_range(const CoarseMap& map, Cell from, double bearing) {
  const Point2 ahead = turned(Point2{1.0, 0.0}, bearing);
  double nearest = std::numeric_limits<double>::infinity();
  for (int y = -1; y <= map.height(); ++y) {
    for (int x = -1; x <= map.width(); ++x) {
      if (Cell{x, y} != from && map.is_occupied({x, y})) {
        nearest = std::min(nearest, entry(middle_of(from), ahead, {x, y}));
      }
    }
  }
  return nearest * map.resolution();
}

TEST(LogRange, CodesFromNothingToTheLongest) {
  const LogRange code;
  EXPECT_EQ(code.coded(0.0), 0);
  EXPECT_EQ(code.coded(code.longest_m), 255);
  EXPECT_EQ(code.coded(1000.0), 255);
}

TEST(LogRange, ComesBackWithinHalfAStep) {
  const LogRange code;
  for (double range_m = 0.0; range_m <= code.longest_m; range_m += 0.01) {
    const double back = code.offset_m * (std::exp(code.coded(range_m) * code.step()) - 1.0);
    EXPECT_LE(std::abs(back - range_m), 0.51 * code.step() * (range_m + code.offset_m));
  }
}

TEST(LogRange, AScaleIsAShift) {
  const LogRange code;
  for (const double scale : {0.7, 0.8, 1.25}) {
    const double shift = std::log(scale) / code.step();
    for (double range_m = 6.0; range_m < 12.0; range_m += 0.5) {
      EXPECT_NEAR(code.exact(scale * range_m) - code.exact(range_m), shift, 1.5) << range_m;
    }
  }
}

TEST(RangeTable, KnowsRangesOfARoom) {
  const CoarseMap map = ascii_map({"#####",  //
                                   "#...#",  //
                                   "#...#",  //
                                   "#####"},
                                  0.5);
  const LogRange code;
  const Cell at{1, 1};
  EXPECT_EQ(expected_code(map, code, at, 0), code.coded(1.25));
  EXPECT_EQ(expected_code(map, code, at, kBearingsPerQuarter), code.coded(0.75));
  EXPECT_EQ(expected_code(map, code, at, 2 * kBearingsPerQuarter), code.coded(0.25));
  EXPECT_EQ(expected_code(map, code, at, 3 * kBearingsPerQuarter), code.coded(0.25));
  EXPECT_EQ(expected_code(map, code, at, 4), code.coded(0.75 / std::sin(40 * kPi / 180)));
}

TEST(RangeTable, StandsOnFreeCellsAndTheirNeighbours) {
  const CoarseMap map = ascii_map({"####",  //
                                   "##.#",  //
                                   "####"});
  const RangeTable table{map, LogRange{}};
  const CoarseMap may_stand = ascii_map({"##.#",  //
                                         "#...",  //
                                         "##.#"});
  for (int y = -1; y <= map.height(); ++y) {
    for (int x = -1; x <= map.width(); ++x) {
      EXPECT_EQ(table.may_stand(padded(map, {x, y})), may_stand.is_free({x, y})) << x << " " << y;
    }
  }
  // From within a wall a ray leaves freely, and then goes as far as from the free cell.
  EXPECT_EQ(table.row(padded(map, {1, 1}))[0], LogRange{}.coded(1.5));
}

TEST(RangeTable, SeesNoFartherThanTheLongestRange) {
  const CoarseMap map = ascii_map({std::string(40, '.')});
  LogRange code;
  code.longest_m = 4.0;
  EXPECT_EQ(expected_code(map, code, {0, 0}, 0), 255);
  EXPECT_EQ(expected_code(map, code, {38, 0}, 0), code.coded(1.5));
}

TEST(RangeTable, EqualsBruteForce) {
  const LogRange code;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const int width = 2 + static_cast<int>(draw_index(rng, 9));
    const int height = 2 + static_cast<int>(draw_index(rng, 9));
    const CoarseMap map = random_map(rng, width, height);
    const RangeTable table{map, code};
    for (std::size_t i = 0; i < map.occupied().size(); ++i) {
      const Cell c = map.occupied().cell_at(i);
      for (int b = 0; b < kBearings && table.may_stand(padded(map, c)); ++b) {
        ASSERT_EQ(table.row(padded(map, c))[b],
                  code.coded(brute_force_range(map, c, bearing_rad(b))))
            << c.x << " " << c.y << " bearing " << b;
      }
    }
  }
}

TEST(RangeTable, AQuarterTurnOfTheMapShiftsItsRows) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const CoarseMap map = random_map(rng, 9, 6);
    const CoarseMap left = turned_left(map);
    const RangeTable table{map, LogRange{}};
    const RangeTable table_left{left, LogRange{}};
    for (std::size_t i = 0; i < map.occupied().size(); ++i) {
      const Cell c = map.occupied().cell_at(i);
      const std::size_t there = padded(left, {map.height() - 1 - c.y, c.x});
      ASSERT_EQ(table.may_stand(padded(map, c)), table_left.may_stand(there));
      for (int b = 0; b < kBearings && table_left.may_stand(there); ++b) {
        ASSERT_EQ(table_left.row(there)[(b + kBearingsPerQuarter) % kBearings],
                  table.row(padded(map, c))[b]);
      }
    }
  }
}

}  // namespace
}  // namespace cmn
