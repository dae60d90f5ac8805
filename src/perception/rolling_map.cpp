// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/rolling_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace cmn {
namespace {

constexpr float kForgotten = 0.05F;

int wrapped(int value, int size) { return ((value % size) + size) % size; }

Cell cell_at(Point2 p, double resolution) {
  return {static_cast<int>(std::floor(p.x / resolution)),
          static_cast<int>(std::floor(p.y / resolution))};
}

}  // namespace

RollingMap::Known& RollingMap::at(Cell c) {
  return known_({wrapped(c.x, known_.width()), wrapped(c.y, known_.height())});
}

void RollingMap::forget() { known_ = {}; }

void RollingMap::scroll_to(Cell middle) {
  const int size = known_.width();
  const int half = size / 2;
  const Cell by = middle - middle_;
  if (std::abs(by.x) >= size || std::abs(by.y) >= size) {
    std::fill(known_.values().begin(), known_.values().end(), Known{});
  } else {
    // Columns, then rows that come into the window.
    for (int i = 0; i < std::abs(by.x); ++i) {
      const int x = by.x > 0 ? middle_.x + size - half + i : middle_.x - half - 1 - i;
      for (int y = 0; y < size; ++y) {
        known_({wrapped(x, size), y}) = {};
      }
    }
    for (int i = 0; i < std::abs(by.y); ++i) {
      const int y = by.y > 0 ? middle_.y + size - half + i : middle_.y - half - 1 - i;
      for (int x = 0; x < size; ++x) {
        known_({x, wrapped(y, size)}) = {};
      }
    }
  }
  middle_ = middle;
}

LocalOccupancy RollingMap::fuse(const LocalOccupancy& look, const Pose2& T_odom_robot) {
  // The square of the look fits into the window however it is turned.
  const int window = static_cast<int>(std::ceil(std::sqrt(2.0) * look.size)) + 2;
  const Cell here = cell_at(T_odom_robot.position(), look.resolution);
  if (known_.width() != window || resolution_ != look.resolution) {
    known_ = Grid<Known>{window, window};
    resolution_ = look.resolution;
    middle_ = here;
  } else {
    scroll_to(here);
    const double driven_m = norm(T_odom_robot.position() - last_);
    const auto keeps = static_cast<float>(std::exp(-driven_m / params_.memory_m));
    for (Known& known : known_.values()) {
      known.confidence *= keeps;
      if (known.confidence < kForgotten) {
        known = {};
      }
    }
  }
  last_ = T_odom_robot.position();

  const double half = 0.5 * look.size;
  const Pose2 T_robot_odom = inverse(T_odom_robot);
  const int reach = window / 2;
  for (int dy = -reach; dy < reach; ++dy) {
    for (int dx = -reach; dx < reach; ++dx) {
      const Cell c = middle_ + Cell{dx, dy};
      const Point2 p = T_robot_odom * (resolution_ * middle_of(c));
      const int ix = static_cast<int>(std::floor(p.x / resolution_ + half));
      const int iy = static_cast<int>(std::floor(p.y / resolution_ + half));
      if (ix < 0 || iy < 0 || ix >= look.size || iy >= look.size) {
        continue;
      }
      const std::size_t i = look.index_of(ix, iy);
      const float news = look.confidence[i];
      if (news > 0.0F) {
        Known& known = at(c);
        known.occupancy = (known.occupancy * known.confidence + look.occupancy[i] * news) /
                          (known.confidence + news);
        known.confidence =
            std::min(known.confidence + news, static_cast<float>(params_.most_looks));
      }
    }
  }

  LocalOccupancy all = look;
  for (int iy = 0; iy < look.size; ++iy) {
    for (int ix = 0; ix < look.size; ++ix) {
      const std::size_t i = look.index_of(ix, iy);
      const Point2 p =
          T_odom_robot * Point2{(ix + 0.5 - half) * resolution_, (iy + 0.5 - half) * resolution_};
      const Known& known = at(cell_at(p, resolution_));
      if (known.confidence > 0.0F) {
        all.occupancy[i] = known.occupancy;
        all.confidence[i] = known.confidence;
      }
    }
  }
  return all;
}

}  // namespace cmn
