// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/coarsen.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

/// A rectangle of pixels or cells, ends excluded.
struct Box {
  int x0, y0, x1, y1;
};

int uniform(std::mt19937& rng, int lowest, int highest) {
  return std::uniform_int_distribution<int>{lowest, highest}(rng);
}

/// A drawing of rooms in a grid of uneven columns and rows, with walls of random thickness that are
/// not aligned with any cell, and doors in some of them.
struct Building {
  Grid<std::uint8_t> occupied;
  std::vector<Box> rooms;
  std::set<std::pair<int, int>> doors;       ///< pairs of rooms, lower first
  std::set<std::pair<int, int>> neighbours;  ///< pairs that share a wall
};

std::vector<std::pair<int, int>> spans(std::mt19937& rng, int count, int shortest, int longest,
                                       int thickest, int& end) {
  std::vector<std::pair<int, int>> result;
  end = uniform(rng, 1, thickest);
  for (int i = 0; i < count; ++i) {
    const int begin = end;
    result.emplace_back(begin, begin + uniform(rng, shortest, longest));
    end = result.back().second + uniform(rng, 1, thickest);
  }
  return result;
}

Building random_building(std::mt19937& rng, double cell) {
  const auto px = [&](double cells) { return static_cast<int>(cells * cell); };
  const int nx = uniform(rng, 1, 4);
  const int ny = uniform(rng, 1, 4);
  const int thickest = std::max(1, px(uniform(rng, 0, 1) == 0 ? 0.3 : 1.4));
  int width = 0;
  int height = 0;
  const auto columns = spans(rng, nx, px(3.5), px(9.0), thickest, width);
  const auto rows = spans(rng, ny, px(3.5), px(9.0), thickest, height);
  Building building;
  building.occupied = Grid<std::uint8_t>{width, height, 1};
  const auto carve = [&](Box box) {
    for (int y = box.y0; y < box.y1; ++y) {
      for (int x = box.x0; x < box.x1; ++x) {
        building.occupied({x, y}) = 0;
      }
    }
  };
  for (const auto& row : rows) {
    for (const auto& column : columns) {
      building.rooms.push_back({column.first, row.first, column.second, row.second});
      carve(building.rooms.back());
    }
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int a = j * nx + i;
      const Box& room = building.rooms[static_cast<std::size_t>(a)];
      const int door = std::max(2, px(0.01 * uniform(rng, 60, 180)));
      if (i + 1 < nx) {
        building.neighbours.insert({a, a + 1});
        if (uniform(rng, 0, 2) > 0) {
          building.doors.insert({a, a + 1});
          const int y = uniform(rng, room.y0, room.y1 - door);
          carve({room.x1, y, building.rooms[static_cast<std::size_t>(a + 1)].x0, y + door});
        }
      }
      if (j + 1 < ny) {
        building.neighbours.insert({a, a + nx});
        if (uniform(rng, 0, 2) > 0) {
          building.doors.insert({a, a + nx});
          const int x = uniform(rng, room.x0, room.x1 - door);
          carve({x, room.y1, x + door, building.rooms[static_cast<std::size_t>(a + nx)].y0});
        }
      }
    }
  }
  return building;
}

/// Labels the 4-connected free cells within a box; -1 where occupied or outside it.
Grid<int> label_free(const Grid<std::uint8_t>& occupied, Box box, int& count) {
  Grid<int> label{occupied.width(), occupied.height(), -1};
  count = 0;
  std::vector<Cell> front;
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      if (occupied({x, y}) != 0 || label({x, y}) >= 0) {
        continue;
      }
      front.assign(1, {x, y});
      label({x, y}) = count;
      while (!front.empty()) {
        const Cell c = front.back();
        front.pop_back();
        for (const Heading h : kHeadings) {
          const Cell next = c + unit_step(h);
          if (next.x >= box.x0 && next.y >= box.y0 && next.x < box.x1 && next.y < box.y1 &&
              occupied(next) == 0 && label(next) < 0) {
            label(next) = count;
            front.push_back(next);
          }
        }
      }
      ++count;
    }
  }
  return label;
}

int count_free_components(const Grid<std::uint8_t>& grid) {
  int count = 0;
  label_free(grid, {0, 0, grid.width(), grid.height()}, count);
  return count;
}

Cell middle_of(const Box& room, double cell) {
  return {static_cast<int>((room.x0 + room.x1) / (2.0 * cell)),
          static_cast<int>((room.y0 + room.y1) / (2.0 * cell))};
}

TEST(CoarsenProperty, KeepsEveryRoomEveryDoorAndEveryWall) {
  int doors = 0;
  int closed = 0;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 rng{seed};
    const double cell = 6.0 + 0.01 * uniform(rng, 0, 1400);
    const Building building = random_building(rng, cell);
    const Grid<std::uint8_t> coarse = coarsen(building.occupied, cell);
    EXPECT_EQ(count_free_components(coarse), count_free_components(building.occupied))
        << ascii(coarse);
    for (const auto& pair : building.neighbours) {
      const Box& a = building.rooms[static_cast<std::size_t>(pair.first)];
      const Box& b = building.rooms[static_cast<std::size_t>(pair.second)];
      const bool has_door = building.doors.count(pair) == 1;
      // A door may come to lie in the row of cells of the wall at its side; no other room's cells
      // may help to join two rooms that have none.
      const double margin = has_door ? 0.0 : 1.0;
      const Box both{static_cast<int>(a.x0 / cell + margin), static_cast<int>(a.y0 / cell + margin),
                     std::min(coarse.width(), static_cast<int>(b.x1 / cell - margin) + 1),
                     std::min(coarse.height(), static_cast<int>(b.y1 / cell - margin) + 1)};
      int count = 0;
      const Grid<int> label = label_free(coarse, both, count);
      const int label_a = label(middle_of(a, cell));
      const int label_b = label(middle_of(b, cell));
      EXPECT_GE(label_a, 0) << ascii(coarse);
      EXPECT_GE(label_b, 0) << ascii(coarse);
      doors += has_door;
      closed += has_door && label_a != label_b;
      if (!has_door) {
        EXPECT_NE(label_a, label_b) << "rooms " << pair.first << " and " << pair.second << "\n"
                                    << ascii(coarse);
      }
    }
  }
  // With 3000 seeds 3 of 14854 doors close and no wall opens. What is lost are second doors beside
  // a corner whose cell another wall needs.
  EXPECT_LE(closed, doors / 500 + 1) << closed << " of " << doors << " doors";
  RecordProperty("doors", doors);
  RecordProperty("closed", closed);
}

TEST(CoarsenProperty, OpensNoWallOfAnyDrawing) {
  for (std::uint32_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 rng{seed};
    // Scribble: random strokes, thin and thick, with no plan at all.
    Grid<std::uint8_t> occupied{uniform(rng, 40, 160), uniform(rng, 40, 160)};
    for (int stroke = uniform(rng, 5, 40); stroke-- > 0;) {
      double x = uniform(rng, 0, occupied.width() - 1);
      double y = uniform(rng, 0, occupied.height() - 1);
      const double dx = 0.1 * uniform(rng, -10, 10);
      const double dy = 0.1 * uniform(rng, -10, 10);
      for (int step = uniform(rng, 10, 200); step-- > 0; x += 0.5 * dx, y += 0.5 * dy) {
        for (const Cell side : {Cell{0, 0}, Cell{1, 0}}) {
          const Cell c = Cell{static_cast<int>(x), static_cast<int>(y)} + side;
          if (occupied.contains(c)) {
            occupied(c) = 1;
          }
        }
      }
    }
    const double cell = 2.0 + 0.01 * uniform(rng, 0, 1200);
    const Grid<std::uint8_t> coarse = coarsen(occupied, cell);
    // Each coarse component must lie within one fine component: count the fine components that
    // any coarse one could stand for. Two cells of one coarse component whose blocks are wholly
    // free must be joined in the drawing.
    int count = 0;
    const Grid<int> fine_label =
        label_free(occupied, {0, 0, occupied.width(), occupied.height()}, count);
    const Grid<int> coarse_label =
        label_free(coarse, {0, 0, coarse.width(), coarse.height()}, count);
    std::vector<std::set<int>> fine_of(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      const Cell c = coarse.cell_at(i);
      std::set<int> labels;
      for (int y = static_cast<int>(std::lround(c.y * cell));
           y < std::min<int>(static_cast<int>(std::lround((c.y + 1) * cell)), occupied.height());
           ++y) {
        for (int x = static_cast<int>(std::lround(c.x * cell));
             x < std::min<int>(static_cast<int>(std::lround((c.x + 1) * cell)), occupied.width());
             ++x) {
          labels.insert(fine_label({x, y}));
        }
      }
      labels.erase(-1);
      if (coarse_label[i] >= 0 && labels.size() == 1) {
        fine_of[static_cast<std::size_t>(coarse_label[i])].insert(*labels.begin());
      }
    }
    for (const std::set<int>& labels : fine_of) {
      EXPECT_LE(labels.size(), 1U) << ascii(coarse);
    }
  }
}

}  // namespace
}  // namespace cmn
