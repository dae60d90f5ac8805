// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/contact_memory.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace cmn {
namespace {

float occupancy_at(const LocalOccupancy& local, double x, double y) {
  return local.occupancy[local.index_of(static_cast<int>(x / local.resolution + 0.5 * local.size),
                                        static_cast<int>(y / local.resolution + 0.5 * local.size))];
}

LocalOccupancy free_ground() {
  LocalOccupancy local{40, 0.1};
  std::fill(local.occupancy.begin(), local.occupancy.end(), 0.0F);
  return local;
}

TEST(ContactMemory, WhatWasTouchedStaysWhereItIsWhileTheRobotMoves) {
  ContactMemory memory{0.17};
  memory.add({1.0, 1.0, 0.0});
  LocalOccupancy ahead = free_ground();
  memory.mark(ahead, {1.0, 1.0, 0.0});
  EXPECT_EQ(occupancy_at(ahead, 0.25, 0.05), 1.0F);
  LocalOccupancy aside = free_ground();
  memory.mark(aside, {1.0, 0.0, kPi / 2.0});  // the contact is 1 m ahead and 0.22 m to the right
  EXPECT_EQ(occupancy_at(aside, 1.05, -0.25), 1.0F);
  EXPECT_EQ(occupancy_at(aside, 0.25, 0.05), 0.0F);
}

TEST(ContactMemory, FarFromWhatWasTouchedNothingChanges) {
  ContactMemory memory{0.17};
  memory.add({9.0, 0.0, 0.0});
  LocalOccupancy local = free_ground();
  memory.mark(local, {});
  EXPECT_EQ(std::count(local.occupancy.begin(), local.occupancy.end(), 1.0F), 0);
  LocalOccupancy none;
  memory.mark(none, {});  // where nobody asked for a local map
}

TEST(ContactMemory, ForgetsByTheWayDriven) {
  ContactMemory memory{0.17};
  memory.add({});
  const auto is_marked = [&](double x) {
    LocalOccupancy local = free_ground();
    memory.mark(local, {x, 0.0, 0.0});
    return std::count(local.occupancy.begin(), local.occupancy.end(), 1.0F) == 1;
  };
  const int looks = static_cast<int>(ContactMemory::kRemembered_m) - 1;
  for (int i = 1; i <= looks; ++i) {
    EXPECT_TRUE(is_marked(i % 2)) << i << " m driven";
  }
  is_marked((looks + 1) % 2);
  EXPECT_FALSE(is_marked(looks % 2)) << "too long ago";
}

TEST(ContactMemory, WhereTheRobotStandsNothingElseIs) {
  ContactMemory memory{0.17};
  memory.add({});
  LocalOccupancy beside = free_ground();
  memory.mark(beside, {0.2, 0.2, 0.0});
  EXPECT_EQ(occupancy_at(beside, 0.05, -0.15), 1.0F);
  LocalOccupancy over = free_ground();
  memory.mark(over, {0.2, 0.0, 0.0});
  EXPECT_EQ(std::count(over.occupancy.begin(), over.occupancy.end(), 1.0F), 0);
}

TEST(ContactMemory, ForgetsWhenTheOdometryBeginsAnew) {
  ContactMemory memory{0.17};
  memory.add({});
  memory.forget();
  LocalOccupancy local = free_ground();
  memory.mark(local, {});
  EXPECT_EQ(occupancy_at(local, 0.25, 0.05), 0.0F);
}

TEST(ContactMemory, KeepsTheNewest) {
  ContactMemory memory{0.17};
  memory.add({});
  for (int i = 0; i < 1000; ++i) {
    memory.add({5.0, 0.0, 0.0});
  }
  LocalOccupancy local = free_ground();
  memory.mark(local, {});
  EXPECT_EQ(occupancy_at(local, 0.25, 0.05), 0.0F);
}

}  // namespace
}  // namespace cmn
