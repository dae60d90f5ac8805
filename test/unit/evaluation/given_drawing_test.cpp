// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/given_drawing.hpp"

#include "coarse_map_nav/data/geometry.hpp"

#include <string>
#include <vector>

#include "ascii_map.hpp"
#include "file_fixture.hpp"
#include <gmock/gmock.h>

namespace cmn {
namespace {

using testing::HasSubstr;

/// A hall of 8 m x 6 m.
CoarseMap hall() { return ascii_map(std::vector<std::string>(60, std::string(80, '.')), 0.1); }

CoarseMap map_of_it() { return ascii_map(std::vector<std::string>(20, std::string(20, '.')), 0.4); }

/// Where a person draws p: at 0.7 of its size, a quarter turn to the left, out of proportion.
Point2 drawn(Point2 p) { return {5.5 - 0.7 * p.y, 0.3 + 0.7 * p.x + 0.02 * p.x * p.y}; }

std::vector<Place> places(Point2 (*draw)(Point2)) {
  std::vector<Place> all;
  for (int x = 0; x <= 8; x += 2) {
    for (int y = 0; y <= 6; y += 2) {
      const Point2 p{static_cast<double>(x), static_cast<double>(y)};
      all.push_back({std::to_string(x) + "_" + std::to_string(y), p, draw(p)});
    }
  }
  return all;
}

TEST(GivenDrawing, LeadsThereAndBack) {
  const Drawing drawing = given_drawing(map_of_it(), places(drawn), hall());
  EXPECT_NEAR(drawing.scale(), 0.73, 0.03);
  for (double x = 0.3; x < 8.0; x += 0.7) {
    for (double y = 0.2; y < 6.0; y += 0.7) {
      const Point2 p{x, y};
      EXPECT_LT(norm(drawing.world_to_map(p) - drawn(p)), 0.05);
      EXPECT_LT(norm(drawing.map_to_world(drawing.world_to_map(p)) - p), 1e-6);
      const Pose2 there = drawing.world_to_map(Pose2{x, y, 0.3});
      EXPECT_NEAR(wrap_angle(there.yaw - 0.3 - kPi / 2.0), 0.0, 0.15);
      EXPECT_NEAR(wrap_angle(drawing.map_to_world(there).yaw - 0.3), 0.0, 1e-6);
    }
  }
}

TEST(GivenDrawing, RefusesPlacesThatMirrorOrMissTheWorld) {
  const auto mirrored = [](Point2 p) { return Point2{7.0 - 0.7 * p.x, 0.7 * p.y}; };
  EXPECT_THAT(error_of([&] { given_drawing(map_of_it(), places(mirrored), hall()); }),
              HasSubstr("fold or mirror the world near"));
  const auto beside = [](Point2 p) { return Point2{p.x + 6.0, p.y}; };
  EXPECT_THAT(error_of([&] { given_drawing(map_of_it(), places(beside), hall()); }),
              HasSubstr("points of the world's free ground"));
  EXPECT_THAT(error_of([&] { given_drawing(map_of_it(), {}, hall()); }),
              HasSubstr("at least 3 places"));
}

}  // namespace
}  // namespace cmn
