// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/range_looks.hpp"

#include "coarse_map_nav/localization/scale_filter.hpp"

#include <string>
#include <vector>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

/// Two corridors that are the same but for a niche at the east end of the lower one.
ScaleFilter two_corridors() {
  const std::string rock(50, '#');
  const std::string corridor = "#" + std::string(48, '.') + "#";
  std::string niche = rock;
  niche.replace(40, 6, "......");
  return {ascii_map({rock, corridor, corridor, rock, rock, rock, rock, niche, niche, niche,
                     corridor, corridor, rock},
                    0.4),
          ScaleFilterParams{}, 0.8};
}

constexpr double kUpper = 10.5;
constexpr double kLower = 1.5;

TEST(RangeLooks, TellNothingBetweenFewerThanTwo) {
  const ScaleFilter filter = two_corridors();
  const ExpectedLooks& looks = *filter.localization().looks;
  EXPECT_TRUE(looks.apart({}, 1.0).empty());
  EXPECT_TRUE(looks.apart({{{10.5, kUpper}, 0.0}}, 1.0).empty());
}

TEST(RangeLooks, TellCorridorsApartWhereTheyDiffer) {
  const ScaleFilter filter = two_corridors();
  const ExpectedLooks& looks = *filter.localization().looks;
  const auto apart = [&](double x) {
    return looks.apart({{{x, kUpper}, 0.0}, {{x, kLower}, 0.0}}, 1.0).front();
  };
  EXPECT_NEAR(apart(10.5), 0.0, 1e-6);
  EXPECT_GT(apart(42.5), 0.5);
}

TEST(RangeLooks, DependOnTheWayThatOneFaces) {
  const ScaleFilter filter = two_corridors();
  const ExpectedLooks& looks = *filter.localization().looks;
  const std::vector<double> nats =
      looks.apart({{{24.5, kUpper}, 0.0}, {{24.5, kUpper}, kPi / 2.0}, {{24.5, kUpper}, 0.0}}, 1.0);
  ASSERT_EQ(nats.size(), 3U);
  EXPECT_GT(nats[0], 0.5);              // 0 and 1
  EXPECT_NEAR(nats[1], 0.0, 1e-6);      // 0 and 2
  EXPECT_NEAR(nats[2], nats[0], 1e-6);  // 1 and 2
}

TEST(RangeLooks, ExpectNothingInsideWallsAndOutside) {
  const ScaleFilter filter = two_corridors();
  const ExpectedLooks& looks = *filter.localization().looks;
  for (const Point2 nowhere : {Point2{24.5, 6.5}, Point2{-3.5, 2.5}, Point2{24.5, 99.5}}) {
    EXPECT_EQ(looks.apart({{nowhere, 0.0}, {{24.5, kUpper}, 0.0}}, 1.0), std::vector<double>{0.0});
  }
}

}  // namespace
}  // namespace cmn
