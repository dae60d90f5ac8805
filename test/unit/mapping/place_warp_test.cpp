// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/place_warp.hpp"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "file_fixture.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using ::testing::HasSubstr;

Point2 affine(Point2 p) { return {2.0 * p.x - 0.3 * p.y + 5.0, 0.4 * p.x + 1.5 * p.y - 7.0}; }

std::vector<Place> random_places(std::size_t count, std::mt19937& rng) {
  std::uniform_real_distribution<double> metres{-20.0, 20.0};
  std::vector<Place> places(count);
  for (Place& place : places) {
    place.world = {100.0 + metres(rng), metres(rng)};
    place.map = affine(place.world);
  }
  return places;
}

TEST(PlaceWarp, IsExactForAnyAffineDrawing) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 rng{seed};
    const PlaceWarp warp{random_places(3 + seed % 10, rng)};
    const Point2 p{107.0, -4.0};
    EXPECT_NEAR(norm(warp.world_to_map(p) - affine(p)), 0.0, 1e-6);
  }
}

TEST(PlaceWarp, MeetsEveryPlaceFromSixOn) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 rng{seed};
    std::normal_distribution<double> error;
    std::vector<Place> places = random_places(6 + seed % 20, rng);
    for (Place& place : places) {
      place.map = place.map + Point2{error(rng), error(rng)};
    }
    const PlaceWarp warp{places};
    for (const Place& place : places) {
      EXPECT_NEAR(norm(warp.world_to_map(place.world) - place.map), 0.0, 1e-6);
    }
  }
}

TEST(PlaceWarp, TakesTheLeastSquaresOfFewPlaces) {
  const std::vector<Place> places{
      {"a", {0, 0}, {0, 0}}, {"b", {1, 0}, {1, 0}}, {"c", {1, 1}, {1, 1}}, {"d", {0, 1}, {0, 1.4}}};
  EXPECT_NEAR(PlaceWarp{places}.world_to_map({0.0, 1.0}).y, 1.3, 1e-9);
}

TEST(PlaceWarp, RefusesPlacesThatDoNotSpanThePlane) {
  std::vector<Place> places(2);
  EXPECT_THAT(error_of([&] { PlaceWarp{places}; }), HasSubstr("at least 3"));
  places.resize(7);
  EXPECT_THAT(error_of([&] { PlaceWarp{places}; }), HasSubstr("one line"));
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i].world = static_cast<double>(i) * Point2{1.0, 2.0};
  }
  EXPECT_THAT(error_of([&] { PlaceWarp{places}; }), HasSubstr("one line"));
  std::mt19937 rng{1};
  places = random_places(7, rng);
  places[3].world = places[4].world;
  EXPECT_THAT(error_of([&] { PlaceWarp{places}; }), HasSubstr("distinct"));
}

}  // namespace
}  // namespace cmn
