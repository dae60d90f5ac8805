// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/local_lattice.hpp"

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/random.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kStep_m = 0.15;

/// Seen from above with the robot facing right, the first line its left: '#' occupied, '?' unseen,
/// all else free. A character is a square of 0.15 m, cut into 3 x 3 cells; an odd number of them,
/// so that the robot stands in the middle of one.
LocalOccupancy seen(const std::vector<std::string>& lines) {
  const auto squares = static_cast<int>(lines.size());
  LocalOccupancy local{3 * squares, kStep_m / 3};
  for (int iy = 0; iy < local.size; ++iy) {
    for (int ix = 0; ix < local.size; ++ix) {
      const char c =
          lines[static_cast<std::size_t>(squares - 1 - iy / 3)][static_cast<std::size_t>(ix / 3)];
      local.occupancy[local.index_of(ix, iy)] = c == '#' ? 1.0F : c == '?' ? 0.5F : 0.0F;
      local.confidence[local.index_of(ix, iy)] = c == '?' ? 0.0F : 1.0F;
    }
  }
  return local;
}

LocalOccupancy empty(int squares) {
  return seen(std::vector<std::string>(static_cast<std::size_t>(squares),
                                       std::string(static_cast<std::size_t>(squares), '.')));
}

/// No clearance beyond the occupied cells themselves, and no price of nearness.
LatticeParams bare() {
  LatticeParams params;
  params.clearance_m = 0.01;
  params.comfort_m = 0.01;
  params.discomfort = 0.0;
  return params;
}

const LatticeState* find(const std::vector<LatticeState>& states, Cell offset, int quarter_turns) {
  const auto found = std::find_if(states.begin(), states.end(), [&](const LatticeState& s) {
    return s.offset == offset && s.quarter_turns == quarter_turns;
  });
  return found == states.end() ? nullptr : &*found;
}

/// From a cell's middle to the nearest occupied cell's border, by looking at all of them; -1 where
/// nothing was seen or outside.
double clearance_m(const LocalOccupancy& local, Point2 p) {
  const int ix = static_cast<int>(std::floor(p.x / local.resolution + 0.5 * local.size));
  const int iy = static_cast<int>(std::floor(p.y / local.resolution + 0.5 * local.size));
  if (ix < 0 || iy < 0 || ix >= local.size || iy >= local.size ||
      local.confidence[local.index_of(ix, iy)] <= 0.0F) {
    return -1.0;
  }
  double nearest = 1e9;
  for (int y = 0; y < local.size; ++y) {
    for (int x = 0; x < local.size; ++x) {
      const std::size_t i = local.index_of(x, y);
      if (local.confidence[i] > 0.0F && local.occupancy[i] > 0.5F) {
        nearest = std::min(nearest, std::hypot(x - ix, y - iy));
      }
    }
  }
  return std::max(0.0, nearest - 0.5) * local.resolution;
}

TEST(LocalLattice, BeginsWhereTheRobotStandsAndGrowsInCost) {
  LocalLattice lattice{bare(), kStep_m};
  const std::vector<LatticeState>& states = lattice.search(empty(9));
  ASSERT_FALSE(states.empty());
  EXPECT_EQ(states.front().cost_m, 0.0);
  EXPECT_EQ(states.front().offset, (Cell{0, 0}));
  EXPECT_EQ(lattice.first_action(0), ActionType::kStop);
  for (std::size_t i = 1; i < states.size(); ++i) {
    EXPECT_GE(states[i].cost_m, states[i - 1].cost_m);
    EXPECT_LT(states[i].parent, static_cast<std::int32_t>(i));
  }
  EXPECT_EQ(states.size(), 9U * 9U * 4U);
}

TEST(LocalLattice, StepsAndTurnsCostWhatTheyShould) {
  LatticeParams params = bare();
  params.turn_cost_m = 0.1;
  LocalLattice lattice{params, kStep_m};
  const std::vector<LatticeState>& states = lattice.search(empty(9));
  EXPECT_NEAR(find(states, {3, 0}, 0)->cost_m, 0.45, 1e-6);
  EXPECT_NEAR(find(states, {0, 0}, 1)->cost_m, 0.1, 1e-6);
  EXPECT_NEAR(find(states, {0, 0}, 3)->cost_m, 0.1, 1e-6);
  EXPECT_NEAR(find(states, {0, 0}, 2)->cost_m, 0.2, 1e-6);
  EXPECT_NEAR(find(states, {2, 1}, 1)->cost_m, 0.3 + 0.1 + 0.15, 1e-6);
  EXPECT_NEAR(find(states, {-1, 0}, 2)->cost_m, 0.2 + 0.15, 1e-6);
}

TEST(LocalLattice, TheFirstActionIsTheOneToBeginWith) {
  LocalLattice lattice{bare(), kStep_m};
  const std::vector<LatticeState>& states = lattice.search(empty(9));
  const auto action_to = [&](Cell offset, int turns) {
    return lattice.first_action(
        static_cast<std::size_t>(find(states, offset, turns) - states.data()));
  };
  EXPECT_EQ(action_to({2, 0}, 0), ActionType::kMoveForward);
  EXPECT_EQ(action_to({0, 2}, 1), ActionType::kTurnLeft);
  EXPECT_EQ(action_to({0, -2}, 3), ActionType::kTurnRight);
}

TEST(LocalLattice, TheWayIsARowOfItsOwnActions) {
  LocalLattice lattice{bare(), kStep_m};
  const std::vector<LatticeState>& states = lattice.search(seen({".......",  //
                                                                 "...#...",  //
                                                                 "..###..",  //
                                                                 ".......",  //
                                                                 "....#..",  //
                                                                 ".#.....",  //
                                                                 "......."}));
  for (std::size_t i = 1; i < states.size(); ++i) {
    const LatticeState& to = states[i];
    const LatticeState& from = states[static_cast<std::size_t>(to.parent)];
    EXPECT_EQ(to.quarter_turns, (from.quarter_turns + quarter_turns(to.action) + 4) % 4);
    const Cell step =
        to.action == ActionType::kMoveForward ? turned(Cell{1, 0}, from.quarter_turns) : Cell{0, 0};
    EXPECT_EQ(to.offset, from.offset + step);
  }
}

TEST(LocalLattice, WalksAroundAWallAndNotThroughIt) {
  LocalLattice lattice{bare(), kStep_m};
  const std::vector<LatticeState>& states = lattice.search(seen({".......",  //
                                                                 "....#..",  //
                                                                 "....#..",  //
                                                                 "....#..",  //
                                                                 "....#..",  //
                                                                 "....#..",  //
                                                                 "......."}));
  EXPECT_EQ(find(states, {1, 0}, 0), nullptr);
  const LatticeState* behind = find(states, {2, 0}, 3);
  ASSERT_NE(behind, nullptr);
  // Left, three up, right, two on, right, three down.
  EXPECT_NEAR(behind->cost_m, 8 * kStep_m + 3 * 0.1, 1e-6);
}

TEST(LocalLattice, UnseenGroundIsNotDrivenOn) {
  LocalLattice lattice{bare(), kStep_m};
  const std::vector<LatticeState>& states = lattice.search(seen({"?????",  //
                                                                 "?...?",  //
                                                                 "?..??",  //
                                                                 "?...?",  //
                                                                 "?????"}));
  for (const LatticeState& state : states) {
    EXPECT_LE(std::abs(state.offset.x), 1);
    EXPECT_LE(std::abs(state.offset.y), 1);
    EXPECT_NE(state.offset, (Cell{1, 0}));
  }
  EXPECT_NE(find(states, {1, 1}, 0), nullptr);
}

TEST(LocalLattice, ABumperRulesOutTheFirstStepOnly) {
  LocalLattice lattice{bare(), kStep_m};
  const std::vector<LatticeState>& states = lattice.search(empty(9), false);
  const LatticeState* ahead = find(states, {1, 0}, 0);
  ASSERT_NE(ahead, nullptr);  // around
  EXPECT_GT(ahead->cost_m, kStep_m + 0.1);
  for (const LatticeState& state : states) {
    EXPECT_FALSE(state.parent == 0 && state.action == ActionType::kMoveForward);
  }
  EXPECT_NEAR(find(states, {0, 1}, 1)->cost_m, 0.1 + kStep_m, 1e-6);
}

TEST(LocalLattice, ARobotThatStandsTooNearMayLeaveButNotComeNearer) {
  LatticeParams params;
  params.clearance_m = 0.2;
  LocalLattice lattice{params, kStep_m};
  // The wall begins 0.075 m ahead of the robot's middle.
  const std::vector<LatticeState>& states = lattice.search(seen({"....#....",  //
                                                                 ".....#...",  //
                                                                 ".....#...",  //
                                                                 ".....#...",  //
                                                                 ".....#...",  //
                                                                 ".....#...",  //
                                                                 ".....#...",  //
                                                                 ".....#...",  //
                                                                 "........."}));
  EXPECT_EQ(find(states, {1, 0}, 0), nullptr);
  EXPECT_NE(find(states, {-1, 0}, 2), nullptr);
  EXPECT_NE(find(states, {-2, 0}, 2), nullptr);
}

/// Single occupied cells on a circle about the robot, as a bumper leaves them.
LocalOccupancy ring(double radius_m, int count) {
  LocalOccupancy local{61, 0.05};
  std::fill(local.occupancy.begin(), local.occupancy.end(), 0.0F);
  std::fill(local.confidence.begin(), local.confidence.end(), 1.0F);
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * kPi * i / count;
    const auto column = [&](double metres) {
      return static_cast<int>(std::floor(metres / local.resolution + 0.5 * local.size));
    };
    local.occupancy[local.index_of(column(radius_m * std::cos(angle)),
                                   column(radius_m * std::sin(angle)))] = 1.0F;
  }
  return local;
}

TEST(LocalLattice, ThinContactsAroundTheRobotDoNotShutItInForGood) {
  LatticeParams params;
  LocalLattice lattice{params, kStep_m};
  EXPECT_GT(lattice.search(ring(0.3, 6)).size(), 400U) << "gaps of 0.3 m";
  EXPECT_LE(lattice.search(ring(0.3, 40)).size(), 4U * 9U) << "no gap at all";
}

TEST(LocalLattice, WhereThereIsRoomTheWholeClearanceIsAskedFor) {
  LatticeParams params;
  LocalLattice lattice{params, kStep_m};
  for (const LatticeState& state : lattice.search(ring(1.0, 20))) {
    EXPECT_LT(norm(lattice.position_of(state)), 1.0) << "gaps of 0.31 m are too narrow";
  }
}

TEST(LocalLatticeProperty, OutsideOfPocketsNoStepComesCloserThanTheClearance) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    LocalOccupancy local{61, 0.05};
    for (std::size_t i = 0; i < local.cell_count(); ++i) {
      const int x = static_cast<int>(i) % local.size - local.size / 2;
      const int y = static_cast<int>(i) / local.size - local.size / 2;
      const bool is_near = std::max(std::abs(x), std::abs(y)) <= 10;
      local.occupancy[i] = draw_uniform(rng) < 0.01 && !is_near ? 1.0F : 0.0F;
      local.confidence[i] = draw_uniform(rng) < 0.02 && !is_near ? 0.0F : 1.0F;
    }
    LatticeParams params;
    params.clearance_m = 0.1 + 0.1 * draw_uniform(rng);
    LocalLattice lattice{params, kStep_m};
    const std::vector<LatticeState>& states = lattice.search(local);
    for (std::size_t i = 1; i < states.size(); ++i) {
      if (states[i].action != ActionType::kMoveForward) {
        continue;
      }
      const LatticeState& from = states[static_cast<std::size_t>(states[i].parent)];
      const Point2 a = lattice.position_of(from);
      const Point2 b = lattice.position_of(states[i]);
      const double start = clearance_m(local, a);
      // OpenCV's distance is exact to 2 % or so.
      const double least = std::min(clearance_m(local, 0.5 * (a + b)), clearance_m(local, b));
      EXPECT_TRUE(least >= params.clearance_m - 0.01 ||
                  (start < params.clearance_m + 0.01 && clearance_m(local, b) > start - 0.01));
      EXPECT_GE(least, 0.0);
    }
  }
}

TEST(LocalLatticeProperty, CostsAreThoseOfAnExhaustiveRelaxation) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    std::vector<std::string> lines(7, std::string(7, '.'));
    for (std::string& line : lines) {
      for (char& c : line) {
        c = draw_uniform(rng) < 0.2 ? '#' : draw_uniform(rng) < 0.1 ? '?' : '.';
      }
    }
    lines[3][3] = '.';
    const LocalOccupancy local = seen(lines);
    LatticeParams params = bare();
    params.turn_cost_m = 0.05 * static_cast<double>(draw_index(rng, 5));
    LocalLattice lattice{params, kStep_m};
    const std::vector<LatticeState>& states = lattice.search(local);

    const auto is_free = [&](Cell offset) {
      return std::abs(offset.x) <= 3 && std::abs(offset.y) <= 3 &&
             lines[static_cast<std::size_t>(3 - offset.y)]
                  [static_cast<std::size_t>(3 + offset.x)] == '.';
    };
    using Key = std::tuple<int, int, int>;
    std::map<Key, double> cost{{Key{0, 0, 0}, 0.0}};
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      const std::map<Key, double> known = cost;
      for (const auto& [key, total] : known) {
        const auto [x, y, q] = key;
        const Cell ahead = Cell{x, y} + turned(Cell{1, 0}, q);
        std::vector<std::pair<Key, double>> next{{Key{x, y, (q + 1) % 4}, params.turn_cost_m},
                                                 {Key{x, y, (q + 3) % 4}, params.turn_cost_m}};
        if (is_free(ahead)) {
          next.push_back({Key{ahead.x, ahead.y, q}, kStep_m});
        }
        for (const auto& [to, price] : next) {
          const auto [entry, is_new] = cost.emplace(to, std::numeric_limits<double>::infinity());
          if (total + price < entry->second - 1e-9) {
            entry->second = total + price;
            has_changed = true;
          }
        }
      }
    }
    EXPECT_EQ(states.size(), cost.size());
    for (const LatticeState& state : states) {
      const auto found = cost.find({state.offset.x, state.offset.y, state.quarter_turns});
      ASSERT_NE(found, cost.end());
      EXPECT_NEAR(state.cost_m, found->second, 0.01);
    }
  }
}

}  // namespace
}  // namespace cmn
