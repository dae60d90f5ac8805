// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/drawing.hpp"

#include "coarse_map_nav/mapping/downsample.hpp"

#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

/// A hall of `width` x `height` metres at 5 cm with walls of 10 cm, in a frame of its own.
struct Hall {
  Hall(double width, double height)
      : occupied{static_cast<int>(width / 0.05), static_cast<int>(height / 0.05)} {
    const double w = width;
    const double h = height;
    block(0.0, 0.0, w, 0.1);
    block(0.0, h - 0.1, w, h);
    block(0.0, 0.0, 0.1, h);
    block(w - 0.1, 0.0, w, h);
  }
  void block(double x0, double y0, double x1, double y1) {
    for (std::size_t i = 0; i < occupied.size(); ++i) {
      const Cell c = occupied.cell_at(i);
      const double x = (c.x + 0.5) * 0.05;
      const double y = (c.y + 0.5) * 0.05;
      if (x > x0 && x < x1 && y > y0 && y < y1) {
        occupied[i] = 1;
      }
    }
  }
  CoarseMap world() const { return {occupied, 0.05, {3.0, -2.0, 0.0}}; }
  Grid<std::uint8_t> occupied;
};

bool is_free_at(const CoarseMap& map, double x, double y) {
  return map.is_free(map.cell_of(map.T_map_grid() * Point2{x, y}));
}

TEST(CoarseGrid, IsTheDownsampledWorldInItsOwnFrame) {
  Hall hall{8.0, 4.0};
  hall.block(3.0, 0.0, 3.5, 2.0);
  const Drawing drawing = coarse_grid(hall.world(), 0.4);
  EXPECT_TRUE(is_same_drawing(drawing.map(), downsampled(hall.world(), 0.4)));
  EXPECT_EQ(drawing.world_to_map(Point2{5.0, 1.5}).x, 5.0);
  EXPECT_EQ(drawing.map_to_world(Point2{5.0, 1.5}).y, 1.5);
  EXPECT_EQ(drawing.world_to_map(Pose2{5.0, 1.5, 0.7}).yaw, 0.7);
  EXPECT_EQ(drawing.scale(), 1.0);
  EXPECT_EQ(drawing.quarter_turns(), 0);
}

TEST(CoarseGrid, WithAClearanceKeepsThinWalls) {
  Hall hall{8.0, 4.0};
  hall.block(4.0, 0.0, 4.1, 2.5);
  const auto is_wall_kept = [&](double clearance) {
    const CoarseMap map = coarse_grid(hall.world(), 0.4, clearance).map();
    return !is_free_at(map, 3.9, 1.0) || !is_free_at(map, 4.1, 1.0);
  };
  EXPECT_FALSE(is_wall_kept(0.0));
  EXPECT_TRUE(is_wall_kept(0.18));
  EXPECT_TRUE(is_free_at(coarse_grid(hall.world(), 0.4, 0.18).map(), 4.1, 3.3));
}

TEST(Drawing, ScalesTurnsAndShiftsInThisOrder) {
  const Drawing drawing{ascii_map({"."}), SmoothWarp{}, 2.0, 1, {10.0, 20.0}, 2.0};
  const Pose2 pose = drawing.world_to_map(Pose2{3.0, 1.0, 0.5});
  EXPECT_NEAR(pose.x, 10.0 - 2.0, 1e-12);
  EXPECT_NEAR(pose.y, 20.0 + 6.0, 1e-12);
  EXPECT_NEAR(pose.yaw, 0.5 + kPi / 2.0, 1e-12);
  const Pose2 back = drawing.map_to_world(pose);
  EXPECT_NEAR(back.x, 3.0, 1e-12);
  EXPECT_NEAR(back.y, 1.0, 1e-12);
  EXPECT_NEAR(back.yaw, 0.5, 1e-12);
}

TEST(WithoutFurniture, KeepsWallsAndWhatHangsOnThem) {
  Hall hall{10.0, 6.0};
  hall.block(5.0, 0.0, 5.1, 4.0);  // a partition
  hall.block(2.0, 2.0, 3.5, 3.0);  // a table
  hall.block(7.0, 0.0, 8.0, 0.6);  // a sideboard
  hall.block(8.0, 3.0, 8.4, 3.4);  // a pillar, or a stool: nobody can tell
  const CoarseMap plan = without_furniture(hall.world());
  EXPECT_FALSE(is_free_at(plan, 5.03, 3.0));
  EXPECT_FALSE(is_free_at(plan, 7.5, 0.3));
  EXPECT_TRUE(is_free_at(plan, 2.7, 2.5));
  EXPECT_TRUE(is_free_at(plan, 8.2, 3.2));
  EXPECT_EQ(plan.T_map_grid().x, 3.0);
}

TEST(WithoutFurniture, KeepsAPieceOfWallBetweenTwoDoors) {
  Hall hall{10.0, 6.0};
  hall.block(5.0, 0.0, 5.1, 1.5);
  hall.block(5.0, 2.4, 5.1, 3.6);
  hall.block(5.0, 4.5, 5.1, 6.0);
  EXPECT_FALSE(is_free_at(without_furniture(hall.world()), 5.03, 3.0));
}

TEST(WithoutFurniture, KeepsAThinWallThatTheLidarSawAsDashes) {
  Hall hall{10.0, 6.0};
  for (int i = 0; i < 15; ++i) {
    hall.block(5.0, 0.3 + 0.3 * i, 5.05, 0.45 + 0.3 * i);
  }
  for (const double x : {2.0, 2.6, 3.2}) {  // the legs of a table
    hall.block(x, 2.0, x + 0.05, 2.05);
    hall.block(x, 2.8, x + 0.05, 2.85);
  }
  const CoarseMap plan = without_furniture(hall.world());
  EXPECT_FALSE(is_free_at(plan, 5.03, 3.03));
  EXPECT_TRUE(is_free_at(plan, 2.63, 2.03));
}

TEST(WithoutFurniture, OpensNothingThatIsClosed) {
  Hall hall{10.0, 6.0};
  hall.block(0.0, 0.0, 3.0, 6.0);  // unknown ground
  const CoarseMap plan = without_furniture(hall.world());
  EXPECT_TRUE(plan.occupied() == hall.world().occupied());
}

TEST(WallsOnly, IsFreeWhereTheCoarseGridIs) {
  Hall hall{10.0, 6.0};
  hall.block(2.0, 2.0, 3.5, 3.0);
  hall.block(6.0, 2.0, 6.4, 2.4);
  const CoarseMap grid = coarse_grid(hall.world(), 0.4).map();
  const CoarseMap plan = walls_only(hall.world(), 0.4).map();
  ASSERT_EQ(grid.occupied().size(), plan.occupied().size());
  for (std::size_t i = 0; i < grid.occupied().size(); ++i) {
    EXPECT_LE(plan.occupied()[i], grid.occupied()[i]);
  }
  EXPECT_GT(plan.free_count(), grid.free_count());
}

TEST(HandDrawn, TheSameSeedGivesTheSameDrawing) {
  Hall hall{12.0, 8.0};
  hall.block(6.0, 0.0, 6.1, 5.0);
  hall.block(2.0, 2.0, 3.0, 3.0);
  const Drawing a = hand_drawn(hall.world(), 0.4, 7);
  const Drawing b = hand_drawn(hall.world(), 0.4, 7);
  const Drawing c = hand_drawn(hall.world(), 0.4, 8);
  EXPECT_TRUE(is_same_drawing(a.map(), b.map()));
  EXPECT_EQ(a.world_to_map(Point2{6.0, 1.0}).x, b.world_to_map(Point2{6.0, 1.0}).x);
  EXPECT_FALSE(is_same_drawing(a.map(), c.map()));
}

TEST(HandDrawn, WithoutAnyFaultIsTheWorldToScale) {
  Hall hall{12.0, 8.0};
  hall.block(6.0, 0.0, 6.8, 5.0);
  HandDrawingParams faultless;
  faultless.stretch = faultless.wobble_m = faultless.dropped_share = faultless.moved_share = 0.0;
  faultless.smallest_scale = faultless.largest_scale = 1.0;
  faultless.turn = false;
  const Drawing drawing = hand_drawn(hall.world(), 0.4, 7, faultless);
  const auto is_free = [&](double x, double y) {
    const Point2 world = hall.world().T_map_grid() * Point2{x, y};
    return drawing.map().is_free(drawing.map().cell_of(drawing.world_to_map(world)));
  };
  EXPECT_NEAR(drawing.scale(), 1.0, 1e-12);
  EXPECT_TRUE(is_free(1.0, 1.0));
  EXPECT_TRUE(is_free(6.4, 6.5));
  EXPECT_TRUE(is_free(11.0, 1.0));
  EXPECT_FALSE(is_free(6.4, 2.0));
  EXPECT_FALSE(is_free(6.4, 0.05));
}

TEST(HandDrawn, LeavesOutSmallFurnitureAsOftenAsTold) {
  Hall hall{30.0, 12.0};
  for (int i = 0; i < 14; ++i) {
    for (int j = 0; j < 5; ++j) {
      hall.block(2.0 + 2.0 * i, 2.0 + 2.0 * j, 2.7 + 2.0 * i, 2.7 + 2.0 * j);
    }
  }
  HandDrawingParams params;
  params.moved_share = 0.0;
  params.stretch = params.wobble_m = 0.0;
  params.dropped_share = 0.5;
  params.smallest_scale = params.largest_scale = 1.0;
  const Drawing drawing = hand_drawn(hall.world(), 0.2, 1, params);
  int left_out = 0;
  for (int i = 0; i < 14; ++i) {
    for (int j = 0; j < 5; ++j) {
      const Point2 p = hall.world().T_map_grid() * Point2{2.35 + 2.0 * i, 2.35 + 2.0 * j};
      left_out += drawing.map().is_free(drawing.map().cell_of(drawing.world_to_map(p)));
    }
  }
  // Binomial, N = 70, p = 0.5: 35 +- 4.2; here 4 standard deviations either way.
  EXPECT_GT(left_out, 18);
  EXPECT_LT(left_out, 52);
}

TEST(HandDrawn, RefusesWhatCannotBeDrawn) {
  const Hall hall{6.0, 4.0};
  EXPECT_THROW(hand_drawn(hall.world(), 0.01, 1), std::invalid_argument);
  EXPECT_THROW(hand_drawn(hall.world(), std::numeric_limits<double>::quiet_NaN(), 1),
               std::invalid_argument);
  HandDrawingParams backwards;
  backwards.smallest_scale = 2.0;
  EXPECT_THROW(hand_drawn(hall.world(), 0.4, 1, backwards), std::invalid_argument);
  HandDrawingParams greedy;
  greedy.dropped_share = greedy.moved_share = 0.7;
  EXPECT_THROW(hand_drawn(hall.world(), 0.4, 1, greedy), std::invalid_argument);
  HandDrawingParams giant;
  giant.walker_radius_m = 2.0;
  EXPECT_THROW(hand_drawn(hall.world(), 0.4, 1, giant), std::runtime_error);
}

}  // namespace
}  // namespace cmn
