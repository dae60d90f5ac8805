// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Tests of WeightLayer.
#include "coarse_map_nav/localization/weight_layer.hpp"

#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using Entries = std::vector<std::pair<std::uint32_t, float>>;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAreArray;

Entries entries_of(const WeightLayer& layer) {
  Entries entries;
  layer.for_each([&](std::uint32_t i, float weight) { entries.emplace_back(i, weight); });
  return entries;
}

TEST(WeightLayer, BeginsEmptyAndListed) {
  const WeightLayer layer{8, 2};
  EXPECT_TRUE(layer.is_listed());
  EXPECT_THAT(entries_of(layer), IsEmpty());
  EXPECT_EQ(layer.sum(), 0.0);
}

TEST(WeightLayer, ListsEachCellOnceAndNoneOfWeightZero) {
  WeightLayer layer{8, 2};
  layer.add(5, 1.0F);
  layer.add(5, 2.0F);
  layer.add(3, 0.0F);
  EXPECT_THAT(layer.list(), ElementsAre(5U));
  EXPECT_EQ(layer[5], 3.0F);
  EXPECT_EQ(layer.sum(), 3.0);
}

TEST(WeightLayer, KeepsNoListOfMany) {
  WeightLayer layer{8, 2};
  for (const std::uint32_t i : {6U, 1U, 4U}) {
    layer.add(i, 1.0F);
  }
  layer.settle();
  EXPECT_FALSE(layer.is_listed());
  EXPECT_EQ(layer.list().capacity(), 0U);
  EXPECT_EQ(entries_of(layer), (Entries{{1, 1.0F}, {4, 1.0F}, {6, 1.0F}}));
}

TEST(WeightLayer, ListsThemAgainWhenTheyHaveBecomeFew) {
  WeightLayer layer{8, 2};
  layer.unlist();
  for (const std::uint32_t i : {6U, 1U, 4U}) {
    layer.add(i, static_cast<float>(i));
  }
  layer.settle();
  ASSERT_FALSE(layer.is_listed());
  layer.for_each([](std::uint32_t i, float& weight) { weight = i == 4U ? 0.0F : weight; });
  layer.settle();
  EXPECT_THAT(layer.list(), ElementsAre(1U, 6U));
}

TEST(WeightLayer, ForgetsCellsThatWereSetToZero) {
  WeightLayer layer{8, 4};
  for (const std::uint32_t i : {6U, 1U, 4U}) {
    layer.add(i, 1.0F);
  }
  layer.for_each([](std::uint32_t i, float& weight) { weight = i == 1U ? 0.0F : 2.0F; });
  layer.settle();
  EXPECT_THAT(entries_of(layer), UnorderedElementsAreArray(Entries{{6, 2.0F}, {4, 2.0F}}));
}

TEST(WeightLayer, ClearsWhatItHeldAndTakesOverHow) {
  for (const bool was_listed : {true, false}) {
    for (const bool is_listed : {true, false}) {
      WeightLayer layer{8, 4};
      WeightLayer other{8, 4};
      if (!was_listed) {
        layer.unlist();
      }
      if (!is_listed) {
        other.unlist();
      }
      layer.add(3, 1.0F);
      layer.clear_like(other);
      EXPECT_EQ(layer.is_listed(), is_listed);
      EXPECT_THAT(entries_of(layer), IsEmpty());
      layer.add(2, 1.0F);
      EXPECT_EQ(entries_of(layer), (Entries{{2, 1.0F}}));
    }
  }
}

}  // namespace
}  // namespace cmn
