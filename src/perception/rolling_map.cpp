// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/rolling_map.hpp"

#include "coarse_map_nav/data/whole_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace cmn {
namespace {

constexpr float kForgotten = 0.05F;

int wrapped(int value, int size) { return ((value % size) + size) % size; }

Cell cell_at(Point2 p, double resolution) {
  return {whole_below(p.x / resolution), whole_below(p.y / resolution)};
}

/// T * point as Pose2 has it, with the sine and cosine worked out once.
class Transform {
 public:
  explicit Transform(const Pose2& T)
      : at_{T.position()}, c_{std::cos(T.yaw)}, s_{std::sin(T.yaw)} {}
  Point2 operator()(Point2 p) const {
    return at_ + Point2{c_ * p.x - s_ * p.y, s_ * p.x + c_ * p.y};
  }

 private:
  Point2 at_;
  double c_;
  double s_;
};

}  // namespace

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
  const Transform to_robot{inverse(T_odom_robot)};
  const int reach = window / 2;
  for (int dy = -reach; dy < reach; ++dy) {
    const int row = wrapped(middle_.y + dy, window);
    int column = wrapped(middle_.x - reach - 1, window);
    for (int dx = -reach; dx < reach; ++dx) {
      column = column + 1 == window ? 0 : column + 1;
      const Cell c = middle_ + Cell{dx, dy};
      const Point2 p = to_robot(resolution_ * middle_of(c));
      const int ix = whole_below(p.x / resolution_ + half);
      const int iy = whole_below(p.y / resolution_ + half);
      if (ix < 0 || iy < 0 || ix >= look.size || iy >= look.size) {
        continue;
      }
      const std::size_t i = look.index_of(ix, iy);
      const float news = look.confidence[i];
      if (news > 0.0F) {
        Known& known = known_({column, row});
        known.occupancy = (known.occupancy * known.confidence + look.occupancy[i] * news) /
                          (known.confidence + news);
        known.confidence =
            std::min(known.confidence + news, static_cast<float>(params_.most_looks));
      }
    }
  }

  const Transform to_odom{T_odom_robot};
  const int corner_x = wrapped(middle_.x - reach, window);
  const int corner_y = wrapped(middle_.y - reach, window);
  LocalOccupancy all = look;
  for (int iy = 0; iy < look.size; ++iy) {
    for (int ix = 0; ix < look.size; ++ix) {
      const std::size_t i = look.index_of(ix, iy);
      const Cell c = cell_at(
          to_odom({(ix + 0.5 - half) * resolution_, (iy + 0.5 - half) * resolution_}), resolution_);
      // Within the window, so that no division is needed to wrap it.
      const int x = corner_x + c.x - (middle_.x - reach);
      const int y = corner_y + c.y - (middle_.y - reach);
      const Known& known = known_({x < window ? x : x - window, y < window ? y : y - window});
      if (known.confidence > 0.0F) {
        all.occupancy[i] = known.occupancy;
        all.confidence[i] = known.confidence;
      }
    }
  }
  return all;
}

}  // namespace cmn
