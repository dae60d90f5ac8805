// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/example_set.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "file_fixture.hpp"
#include "learning_examples.hpp"
#include <gmock/gmock.h>

namespace cmn {
namespace {

using ::testing::HasSubstr;

TEST(ExampleSet, PartsHousesEightToOneToOne) {
  std::array<int, 3> houses{};
  for (std::uint32_t seed = 0; seed < 20000; ++seed) {
    ++houses[static_cast<std::size_t>(split_of(seed))];
  }
  EXPECT_NEAR(houses[0], 16000, 300);
  EXPECT_NEAR(houses[1], 2000, 300);
  EXPECT_NEAR(houses[2], 2000, 300);
}

TEST(ExampleSet, HoldsOnlyHousesOfItsSplit) {
  const std::string folder = fresh_folder("examples");
  std::mt19937_64 rng{1};
  std::array<std::size_t, 3> expected{};
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    write_examples(folder + "/" + std::to_string(seed) + ".h5", seed,
                   std::vector<Example>(1 + seed % 3));
    expected[static_cast<std::size_t>(split_of(seed))] += 1 + seed % 3;
  }
  for (const Split split : {Split::kTrain, Split::kValidation, Split::kTest}) {
    EXPECT_EQ(ExampleSet(folder, split).size(), expected[static_cast<std::size_t>(split)]);
  }
}

TEST(ExampleSet, NeverTrainsOnWorldsThatNoGeneratorMade) {
  EXPECT_EQ(split_of(kForeignWorld), Split::kTest);
}

TEST(ExampleSet, NamesFoldersThatHoldNothing) {
  EXPECT_THAT(error_of([] { ExampleSet("/nowhere", Split::kTrain); }),
              HasSubstr("/nowhere: is no folder"));
  const std::string empty = fresh_folder("empty");
  EXPECT_THAT(error_of([&] { ExampleSet(empty, Split::kTest); }),
              HasSubstr("holds no example for test"));
  EXPECT_THAT(error_of([] { parse_split("tset"); }), HasSubstr("train, validation or test"));
}

TEST(ExampleSet, NamesADamagedFileAmongGoodOnes) {
  const std::string folder = toy_folder(1);
  std::ofstream{folder + "/x.h5"} << "garbage";
  EXPECT_THAT(error_of([&] { ExampleSet(folder, Split::kTrain); }), HasSubstr("x.h5: is no HDF5"));
}

TEST(ShuffledOrder, IsAPermutationOfItsSeedAndEpoch) {
  const std::vector<std::size_t> order = shuffled_order(100, 7, 3);
  EXPECT_EQ(order, shuffled_order(100, 7, 3));
  EXPECT_NE(order, shuffled_order(100, 7, 4));
  EXPECT_NE(order, shuffled_order(100, 8, 3));
  std::vector<std::size_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::size_t> all(100);
  std::iota(all.begin(), all.end(), std::size_t{0});
  EXPECT_EQ(sorted, all);
}

}  // namespace
}  // namespace cmn
