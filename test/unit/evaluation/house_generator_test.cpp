// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/house_generator.hpp"

#include "coarse_map_nav/evaluation/house_picture.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(HouseGenerator, TheSameSeedGivesTheSameHouse) {
  const CoarseMap a = occupancy(generate_house(5), 0.05);
  EXPECT_TRUE(is_same_drawing(a, occupancy(generate_house(5), 0.05)));
  EXPECT_FALSE(is_same_drawing(a, occupancy(generate_house(6), 0.05)));
}

TEST(HouseGenerator, KeepsToOtherSizes) {
  HouseParams params;
  params.smallest_m2 = 60.0;
  params.largest_m2 = 66.0;
  params.narrowest_door_m = params.widest_door_m = 0.85;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const House house = generate_house(seed, params);
    EXPECT_GE(house.area_m2(), 60.0);
    EXPECT_LE(house.area_m2(), 66.0);
    for (const Opening& opening : house.openings) {
      if (opening.kind == Opening::Kind::kDoor) {
        EXPECT_NEAR(opening.width_m(), 0.85, 1e-9);
      }
    }
  }
}

TEST(HouseGenerator, RefusesParametersThatContradictEachOther) {
  HouseParams params;
  params.smallest_m2 = 90.0;
  params.largest_m2 = 80.0;
  EXPECT_THROW(generate_house(1, params), std::invalid_argument);
  params = {};
  params.narrowest_door_m = 1.0;
  EXPECT_THROW(generate_house(1, params), std::invalid_argument);
}

TEST(HousePicture, HasTheHouseAtItsScale) {
  const House house = generate_house(3);
  const cv::Mat picture = house_picture(house, 20.0);
  EXPECT_EQ(picture.cols, static_cast<int>(house.outline.x1 * 20.0 + 40.0));
  EXPECT_EQ(picture.type(), CV_8UC3);
  EXPECT_FALSE(house_sheet({house, house}, {"a", "b"}).empty());
}

}  // namespace
}  // namespace cmn
