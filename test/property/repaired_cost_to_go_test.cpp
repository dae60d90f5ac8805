// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What holds on any repaired map: the cheapest way is the cheapest, and leads to the goal.
#include "coarse_map_nav/planning/repaired_cost_to_go.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "random_case.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

/// Drawn at random, with some looks at random and some failures.
void look_anywhere(std::mt19937_64& rng, RepairedMap& map) {
  LocalOccupancy seen = random_observation(rng, 24, 1.2);
  for (float& o : seen.occupancy) {
    o = o > 0.99F ? 1.0F : 0.0F;
  }
  ClearanceMap clearance;
  clearance.measure(seen, 0.19);
  const Point2 position_cells{map.width() * draw_uniform(rng) / map.cuts(),
                              map.height() * draw_uniform(rng) / map.cuts()};
  map.fuse(seen, clearance, 0.19, position_cells, 6.0 * draw_uniform(rng));
}

RepairedMap random_repaired_map(std::mt19937_64& rng) {
  const int width = 2 + static_cast<int>(draw_index(rng, 7));
  const int height = 2 + static_cast<int>(draw_index(rng, 7));
  RepairedMap map{random_map(rng, width, height), MapRepairParams{}};
  for (int i = 0; i < 4; ++i) {
    look_anywhere(rng, map);
    map.mark_failed({static_cast<int>(draw_index(rng, map.width())),
                     static_cast<int>(draw_index(rng, map.height()))});
  }
  return map;
}

Cell random_part(std::mt19937_64& rng, const RepairedMap& map) {
  return {static_cast<int>(draw_index(rng, static_cast<std::size_t>(map.width()))),
          static_cast<int>(draw_index(rng, static_cast<std::size_t>(map.height())))};
}

int price(const RepairedMap& map, Cell part, Cell goal) {
  return part == goal ? 1 : map.cost(part);
}

/// Bellman and Ford: relaxes every step of the map until none helps.
Grid<double> brute_force_costs(const RepairedMap& map, Cell goal) {
  Grid<double> cost{map.width(), map.height(), std::numeric_limits<double>::infinity()};
  cost(goal) = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < cost.size(); ++i) {
      for (const Heading h : kHeadings) {
        const Cell to = cost.cell_at(i) + unit_step(h);
        if (cost.contains(to) && cost(to) + price(map, to, goal) < cost[i]) {
          cost[i] = cost(to) + price(map, to, goal);
          changed = true;
        }
      }
    }
  }
  return cost;
}

TEST(RepairedCostToGoProperty, EqualsBruteForce) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const RepairedMap map = random_repaired_map(rng);
    const Cell goal = random_part(rng, map);
    const RepairedCostToGo cost_to_go{map, goal};
    const Grid<double> expected = brute_force_costs(map, goal);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_EQ(cost_to_go(expected.cell_at(i)), expected[i]);
    }
  }
}

TEST(RepairedCostToGoProperty, AfterAnyChangesIsThatOfASearchFromTheBeginning) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    RepairedMap map = random_repaired_map(rng);
    const Cell goal = random_part(rng, map);
    RepairedCostToGo cost_to_go{map, goal};
    map.take_changed();
    for (int round = 0; round < 20; ++round) {
      if (draw_uniform(rng) < 0.3) {
        map.mark_failed(random_part(rng, map));
      } else {
        look_anywhere(rng, map);
      }
      cost_to_go.change(map, map.take_changed());
      const RepairedCostToGo anew{map, goal};
      // Asked for less than all, the search ends somewhere on the way.
      for (int i = 0; i < 3; ++i) {
        const Cell part = random_part(rng, map);
        ASSERT_EQ(cost_to_go.next(part), anew.next(part));
        ASSERT_EQ(cost_to_go(part), anew(part));
        const Point2 p{map.width() * draw_uniform(rng), map.height() * draw_uniform(rng)};
        ASSERT_EQ(cost_to_go.between(p), anew.between(p));
      }
    }
  }
}

TEST(RepairedCostToGoProperty, LeadsFromEverywhereToTheGoalAtItsPrice) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const RepairedMap map = random_repaired_map(rng);
    const RepairedCostToGo cost_to_go{map, random_part(rng, map)};
    EXPECT_FALSE(cost_to_go.next(cost_to_go.goal()));
    for (int i = 0; i < 20; ++i) {
      Cell part = random_part(rng, map);
      const double promised = cost_to_go(part);
      double paid = 0.0;
      while (const auto next = cost_to_go.next(part)) {
        part = *next;
        paid += price(map, part, cost_to_go.goal());
        ASSERT_LE(paid, promised);
      }
      EXPECT_EQ(part, cost_to_go.goal());
      EXPECT_EQ(paid, promised);
    }
  }
}

TEST(RepairedCostToGoProperty, BetweenTheMiddlesItLiesBetweenTheNeighbours) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const RepairedMap map = random_repaired_map(rng);
    const RepairedCostToGo cost_to_go{map, random_part(rng, map)};
    for (int i = 0; i < 50; ++i) {
      const Point2 p{map.width() * draw_uniform(rng), map.height() * draw_uniform(rng)};
      const Cell home{static_cast<int>(p.x), static_cast<int>(p.y)};
      EXPECT_NEAR(cost_to_go.between(p), cost_to_go(home), 2.0);
      EXPECT_DOUBLE_EQ(cost_to_go.between(middle_of(home)), cost_to_go(home));
    }
    // Outside nothing is near.
    EXPECT_GT(cost_to_go.between({-3.3, 0.5}), 1e6);
    EXPECT_GT(cost_to_go({0, map.height()}), 1e6);
  }
}

}  // namespace
}  // namespace cmn
