// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/drawing.hpp"

#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cmn {
namespace {

CoarseMap shipped_world(const std::string& name) {
  return read_map(std::string{CMN_SOURCE_DIR} + "/worlds/" + name + ".yaml");
}

/// Regions of cells for which `is_open` holds, 4-connected; -1 elsewhere.
template <class IsOpen>
Grid<int> regions(int width, int height, IsOpen&& is_open) {
  Grid<int> region{width, height, -1};
  int count = 0;
  for (std::size_t i = 0; i < region.size(); ++i) {
    if (region[i] >= 0 || !is_open(region.cell_at(i))) {
      continue;
    }
    std::vector<Cell> front{region.cell_at(i)};
    region[i] = count;
    while (!front.empty()) {
      const Cell c = front.back();
      front.pop_back();
      for (const Heading h : kHeadings) {
        const Cell next = c + unit_step(h);
        if (region.contains(next) && region(next) < 0 && is_open(next)) {
          region(next) = count;
          front.push_back(next);
        }
      }
    }
    ++count;
  }
  return region;
}

TEST(HandDrawnProperty, TheCorrespondenceIsInvertibleAndWithinItsBounds) {
  const CoarseMap world = shipped_world("office");
  const HandDrawingParams params;
  std::set<int> turns;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Drawing drawing = hand_drawn(world, 0.4, seed);
    turns.insert(drawing.quarter_turns());
    EXPECT_GE(drawing.scale(), params.smallest_scale);
    EXPECT_LE(drawing.scale(), params.largest_scale);
    std::mt19937_64 rng{seed};
    for (int i = 0; i < 200; ++i) {
      const Point2 p{25.0 * draw_uniform(rng), 14.0 * draw_uniform(rng)};
      EXPECT_NEAR(norm(drawing.map_to_world(drawing.world_to_map(p)) - p), 0.0, 1e-6);
      const Jacobian2 j = drawing.jacobian(p);
      EXPECT_GT(j.determinant(), 0.0);
      if (world.is_free(world.cell_of(p))) {
        // Fitted at 4000 places; what is missed in between is less than a hundredth.
        EXPECT_GE(j.stretches().first / drawing.scale(), 1.0 - params.stretch - 0.01);
        EXPECT_LE(j.stretches().second / drawing.scale(), 1.0 + params.stretch + 0.01);
      }
      const Pose2 pose{p.x, p.y, 6.0 * draw_uniform(rng)};
      const Pose2 back = drawing.map_to_world(drawing.world_to_map(pose));
      EXPECT_NEAR(wrap_angle(back.yaw - pose.yaw), 0.0, 1e-6);
    }
  }
  EXPECT_EQ(turns.size(), 4U);
}

TEST(HandDrawnProperty, WhatTheRobotCanReachIsOneRegion) {
  std::size_t places = 0;
  std::size_t lost = 0;
  for (const char* name : {"home", "office", "lab", "loop"}) {
    const CoarseMap map = shipped_world(name);
    const World world{map};
    const Grid<int> reach = regions(map.width(), map.height(), [&](Cell c) {
      return world.is_disc_free(map.center_of(c), 0.18);
    });
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
      SCOPED_TRACE(name + std::string{" seed "} + std::to_string(seed));
      const Drawing drawing = hand_drawn(map,
                                         seed % 3 == 0   ? 0.3
                                         : seed % 3 == 1 ? 0.4
                                                         : 0.5,
                                         seed);
      const CoarseMap& coarse = drawing.map();
      const Grid<int> drawn =
          regions(coarse.width(), coarse.height(), [&](Cell c) { return coarse.is_free(c); });
      // Of each region of the world: how many of its places lie in each region of the drawing, or
      // one cell beside it.
      std::map<int, std::map<int, std::size_t>> shares;
      std::map<int, std::size_t> totals;
      for (std::size_t i = 0; i < reach.size(); ++i) {
        if (reach[i] < 0) {
          continue;
        }
        const Cell at = coarse.cell_of(drawing.world_to_map(map.center_of(reach.cell_at(i))));
        std::set<int> seen;
        for (const int dx : {-1, 0, 1}) {
          for (const int dy : {-1, 0, 1}) {
            const Cell c = at + Cell{dx, dy};
            if (drawn.contains(c) && drawn(c) >= 0) {
              seen.insert(drawn(c));
            }
          }
        }
        for (const int region : seen) {
          ++shares[reach[i]][region];
        }
        ++totals[reach[i]];
      }
      for (const auto& total : totals) {
        std::size_t most = 0;
        for (const auto& share : shares[total.first]) {
          most = std::max(most, share.second);
        }
        if (total.second > 400) {  // a square metre: smaller pockets are not drawn
          places += total.second;
          lost += total.second - most;
        }
      }
    }
  }
  RecordProperty("places", static_cast<int>(places));
  RecordProperty("lost", static_cast<int>(lost));
  // Measured: 54 of 1557300, nooks that lie a cell from anything drawn; allowed: 1 of 5000.
  EXPECT_LE(lost, places / 5000) << "of " << places;
}

}  // namespace
}  // namespace cmn
