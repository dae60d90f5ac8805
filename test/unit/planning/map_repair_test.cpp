// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/map_repair.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kClearance_m = 0.19;

/// Two rooms of 2 m x 2.4 m with a wall of one cell between them, in cells of 0.4 m.
CoarseMap two_rooms() { return ascii_map(std::vector<std::string>(6, ".....#....."), 0.4); }

/// 3.2 m x 3.2 m about the robot, all seen; `is_wall` in the robot's frame.
LocalOccupancy view(const std::function<bool(Point2)>& is_wall) {
  LocalOccupancy seen{64, 0.05};
  for (int iy = 0; iy < seen.size; ++iy) {
    for (int ix = 0; ix < seen.size; ++ix) {
      const Point2 p{(ix + 0.5 - 32) * seen.resolution, (iy + 0.5 - 32) * seen.resolution};
      seen.occupancy[seen.index_of(ix, iy)] = is_wall(p) ? 1.0F : 0.0F;
      seen.confidence[seen.index_of(ix, iy)] = 1.0F;
    }
  }
  return seen;
}
LocalOccupancy open() {
  return view([](Point2) { return false; });
}
LocalOccupancy wall_ahead() {
  return view([](Point2 p) { return p.x > 0.4 && p.x < 0.8; });
}

bool look(RepairedMap& map, const LocalOccupancy& seen, Point2 position_cells, double yaw_rad = 0.0,
          double scale = 1.0) {
  ClearanceMap clearance;
  clearance.measure(seen, 0.5);
  return map.fuse(seen, clearance, kClearance_m, position_cells, yaw_rad, scale);
}

constexpr Point2 kBeforeWall{3.5, 3.0};  // 0.6 m west of the wall, which is x from 5 to 6

TEST(RepairedMap, CutsTheCellsOfTheDrawing) {
  const auto cuts = [](double resolution, double cell_m) {
    MapRepairParams params;
    params.cell_m = cell_m;
    return RepairedMap{ascii_map({".#"}, resolution), params}.cuts();
  };
  EXPECT_EQ(cuts(0.4, 0.2), 2);
  EXPECT_EQ(cuts(0.5, 0.2), 3);
  EXPECT_EQ(cuts(0.2, 0.2), 1);
  EXPECT_EQ(cuts(0.1, 0.2), 1);
  EXPECT_EQ(cuts(0.6, 0.2), 3);  // although 0.6 / 0.2 > 3 in floating point or not
}

TEST(RepairedMap, BeginsAsDrawn) {
  const RepairedMap map{ascii_map({".#", ".."}, 0.4), MapRepairParams{}};
  EXPECT_EQ(ascii(map.as_map().occupied()),
            "..##\n"
            "..##\n"
            "....\n"
            "....\n");
  EXPECT_DOUBLE_EQ(map.as_map().resolution(), 0.2);
  EXPECT_EQ(map.cost({0, 0}), 1);
  EXPECT_EQ(map.cost({3, 3}), MapRepairParams{}.drawn_wall_cost);
  EXPECT_EQ(map.part_of({1.6, 0.4}), (Cell{3, 0}));
  EXPECT_EQ(map.part_of({-0.1, 0.4}), (Cell{-1, 0}));
}

TEST(RepairedMap, ADrawnWallThatIsSeenOpenOpens) {
  RepairedMap map{two_rooms(), MapRepairParams{}};
  const Cell wall = map.part_of({5.25, 3.25});
  look(map, open(), kBeforeWall);
  EXPECT_FALSE(map.is_open(wall));  // one look against the drawing's one
  EXPECT_TRUE(look(map, open(), kBeforeWall));
  EXPECT_TRUE(map.is_open(wall));
  EXPECT_EQ(map.cost(wall), 1);
  EXPECT_FALSE(look(map, open(), kBeforeWall));
  // What is out of view stays as drawn.
  EXPECT_TRUE(map.is_open({0, 0}));
  EXPECT_TRUE(map.is_open(map.part_of({10.5, 3.0})));
  map.forget();
  EXPECT_FALSE(map.is_open(wall));
}

TEST(RepairedMap, ADrawnPassageThatIsSeenBlockedCloses) {
  RepairedMap map{two_rooms(), MapRepairParams{}};
  const Point2 at{1.5, 3.0};
  const Cell blocked = map.part_of({3.0, 3.25});  // 0.6 m ahead
  look(map, wall_ahead(), at);
  EXPECT_TRUE(map.is_open(blocked));
  EXPECT_TRUE(look(map, wall_ahead(), at));
  EXPECT_FALSE(map.is_open(blocked));
  EXPECT_EQ(map.cost(blocked), MapRepairParams{}.seen_wall_cost);
  // What stood there went away: as many looks open it as had closed it, at most a few.
  for (int i = 0; i < 20; ++i) {
    look(map, wall_ahead(), at);
  }
  int looks = 0;
  for (; looks < 10 && !map.is_open(blocked); ++looks) {
    look(map, open(), at);
  }
  EXPECT_LE(looks, 5);
  EXPECT_TRUE(map.is_open(blocked));
}

TEST(RepairedMap, AlternatingLooksDoNotFlicker) {
  // What stands 0.6 m ahead is seen there in every other look, as at the rim of a wall.
  for (const bool is_wall_first : {true, false}) {
    RepairedMap on_free{two_rooms(), MapRepairParams{}};
    RepairedMap on_wall{two_rooms(), MapRepairParams{}};
    for (int i = 0; i < 40; ++i) {
      const LocalOccupancy seen = (i % 2 == 0) == is_wall_first ? wall_ahead() : open();
      const bool has_changed = look(on_free, seen, {1.5, 3.0});
      look(on_wall, seen, {4.0, 3.0});
      EXPECT_TRUE(on_free.is_open(on_free.part_of({3.0, 3.25}))) << i;
      EXPECT_TRUE(i < 2 || !has_changed) << i;
      EXPECT_FALSE(on_wall.is_open(on_wall.part_of({5.5, 3.25}))) << i;
    }
  }
}

TEST(RepairedMap, LooksAlongTheYawAndAtTheScale) {
  RepairedMap map{ascii_map(std::vector<std::string>(12, std::string(12, '.')), 0.4),
                  MapRepairParams{}};
  for (int i = 0; i < 2; ++i) {
    look(map, wall_ahead(), {6.0, 6.0}, kPi / 2.0);
  }
  EXPECT_FALSE(map.is_open(map.part_of({6.1, 7.5})));  // 0.6 m north
  EXPECT_TRUE(map.is_open(map.part_of({7.5, 6.1})));
  map.forget();
  for (int i = 0; i < 2; ++i) {
    look(map, wall_ahead(), {3.0, 6.0}, 0.0, 2.0);
  }
  EXPECT_FALSE(map.is_open(map.part_of({6.0, 6.1})));  // 0.6 m are 1.2 m drawn
  EXPECT_TRUE(map.is_open(map.part_of({3.6, 6.1})));
}

TEST(RepairedMap, NothingIsLearnedOfWhatIsUnseenOrOffTheMap) {
  RepairedMap map{two_rooms(), MapRepairParams{}};
  EXPECT_FALSE(look(map, LocalOccupancy{64, 0.05}, kBeforeWall));
  EXPECT_FALSE(look(map, wall_ahead(), {-50.0, 3.0}));
  EXPECT_TRUE(is_same_drawing(map.as_map(), RepairedMap{two_rooms(), {}}.as_map()));
}

TEST(RepairedMap, WhereTheRobotFailedIsClosedUntilForgotten) {
  RepairedMap map{two_rooms(), MapRepairParams{}};
  const Cell part = map.part_of({3.0, 3.25});
  EXPECT_TRUE(map.mark_failed(part));
  EXPECT_FALSE(map.mark_failed(part));
  EXPECT_FALSE(map.mark_failed({-1, 0}));
  for (int i = 0; i < 5; ++i) {
    look(map, open(), {1.5, 3.0});  // it still looks open
  }
  EXPECT_FALSE(map.is_open(part));
  EXPECT_GT(map.cost(part), MapRepairParams{}.seen_wall_cost);
  map.forget_failures();
  EXPECT_TRUE(map.is_open(part));
  EXPECT_EQ(map.cost(part), 1);
}

TEST(RepairedMap, ExchangesWhatWasLearned) {
  RepairedMap map{two_rooms(), MapRepairParams{}};
  for (int i = 0; i < 3; ++i) {
    look(map, open(), kBeforeWall);
  }
  map.mark_failed({0, 0});
  const CoarseMap learned = map.as_map();
  map.take_changed();
  const RepairedMap::Learned before = map.exchange({});
  EXPECT_TRUE(is_same_drawing(map.as_map(), RepairedMap{two_rooms(), {}}.as_map()));
  const std::vector<Cell> changed = map.take_changed();
  for (const Cell part : {Cell{0, 0}, map.part_of({5.25, 3.25})}) {
    EXPECT_NE(std::find(changed.begin(), changed.end(), part), changed.end());
  }
  map.exchange(before);
  EXPECT_TRUE(is_same_drawing(map.as_map(), learned));
  EXPECT_EQ(map.take_changed(), changed);
  // As firm as before: one look does not close what three opened.
  look(map, wall_ahead(), kBeforeWall);
  EXPECT_TRUE(map.is_open(map.part_of({5.25, 3.25})));
}

}  // namespace
}  // namespace cmn
