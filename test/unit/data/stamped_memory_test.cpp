// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/data/stamped_memory.hpp"

#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(StampedMemory, KnowsTheLastValuesByTheirTime) {
  StampedMemory<int> memory;
  memory.remember(10.0, 1);
  memory.remember(10.1, 2);
  ASSERT_NE(memory.at(10.0), nullptr);
  EXPECT_EQ(*memory.at(10.0), 1);
  EXPECT_EQ(memory.at(10.05), nullptr);
  for (std::size_t i = 0; i < StampedMemory<int>::kMost; ++i) {
    memory.remember(11.0 + 0.1 * static_cast<double>(i), 3);
  }
  EXPECT_EQ(memory.at(10.1), nullptr) << "forgotten";
}

TEST(StampedMemory, GivesTheNextLaterOneNeverAnEarlierOne) {
  StampedMemory<int> memory;
  memory.remember(10.0, 1);
  memory.remember(10.2, 2);
  memory.remember(10.3, 3);
  EXPECT_EQ(*memory.at_or_after(10.0), 1);
  EXPECT_EQ(*memory.at_or_after(10.1), 2);
  EXPECT_EQ(*memory.at_or_after(1.0), 1);
  EXPECT_EQ(memory.at_or_after(10.4), nullptr);
}

TEST(StampedMemory, ForgetsTheFutureWhenTimeGoesBack) {
  StampedMemory<int> memory;
  memory.remember(10.0, 1);
  memory.remember(5.0, 2);
  EXPECT_EQ(memory.at(10.0), nullptr);
  EXPECT_EQ(*memory.at(5.0), 2);
}

}  // namespace
}  // namespace cmn
