// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/rolling_map.hpp"

#include "coarse_map_nav/data/whole_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include <opencv2/core.hpp>

namespace cmn {
namespace {

constexpr float kForgotten = 0.05F;

// Alignment: what is searched, and what odometry's word is worth there, in shares of the points.
constexpr double kTurn_deg = 0.5;
constexpr double kShift = 0.5;  ///< [cells]
constexpr int kShifts = 2;      ///< either way
constexpr double kPriceOfTurn = 0.01;
constexpr double kPriceOfShift = 0.2;
constexpr std::size_t kMostPoints = 400;
constexpr std::size_t kLeastPoints = 20;

int wrapped(int value, int size) { return ((value % size) + size) % size; }

Cell cell_at(Point2 p, double resolution) {
  return {whole_below(p.x / resolution), whole_below(p.y / resolution)};
}

/// pose * point as Pose2 has it, with the sine and cosine worked out once.
class Transform {
 public:
  explicit Transform(const Pose2& pose)
      : at_{pose.position()}, c_{std::cos(pose.yaw)}, s_{std::sin(pose.yaw)} {}
  Point2 operator()(Point2 p) const {
    return at_ + Point2{c_ * p.x - s_ * p.y, s_ * p.x + c_ * p.y};
  }

 private:
  Point2 at_;
  double c_;
  double s_;
};

/// At most kMostPoints, evenly thinned.
std::vector<Point2> thinned(std::vector<Point2> points) {
  const std::size_t every = points.size() / kMostPoints + 1;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); i += every) {
    points[kept++] = points[i];
  }
  points.resize(kept);
  return points;
}

}  // namespace

void RollingMap::forget() { known_ = {}; }

cv::Mat RollingMap::surfaces() const {
  const int size = known_.width();
  cv::Mat image(size, size, CV_32F);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Cell c = middle_ + Cell{x - size / 2, y - size / 2};
      const Known& known = known_({wrapped(c.x, size), wrapped(c.y, size)});
      image.at<float>(y, x) = known.confidence > 0.0F ? known.occupancy - 0.5F : 0.0F;
    }
  }
  return image;
}

Pose2 RollingMap::aligned(const LocalOccupancy& look, const Pose2& T_map_robot) const {
  const std::vector<Point2> surface = thinned(surface_of(look));
  if (surface.size() < kLeastPoints) {
    return T_map_robot;
  }
  const cv::Mat known = surfaces();
  const Point2 corner = middle_of(middle_ - Cell{known.cols / 2, known.rows / 2});
  // Mean of what is known where the surface would lie, between the middles of cells.
  const auto fit = [&](const Pose2& pose) {
    const Transform to_map{pose};
    double sum = 0.0;
    for (const Point2 p_robot : surface) {
      const Point2 p = (1.0 / resolution_) * to_map(p_robot) - corner;
      const int x = whole_below(p.x);
      const int y = whole_below(p.y);
      if (x >= 0 && y >= 0 && x + 1 < known.cols && y + 1 < known.rows) {
        const double u = p.x - x;
        const double v = p.y - y;
        const float* low = known.ptr<float>(y) + x;
        const float* high = known.ptr<float>(y + 1) + x;
        sum += (1.0 - v) *
                   ((1.0 - u) * static_cast<double>(low[0]) + u * static_cast<double>(low[1])) +
               v * ((1.0 - u) * static_cast<double>(high[0]) + u * static_cast<double>(high[1]));
      }
    }
    return sum / static_cast<double>(surface.size());
  };
  Pose2 best = T_map_robot;
  double best_fit = fit(best);
  const auto consider = [&](const Pose2& pose) {
    const double turn_deg = std::abs(wrap_angle(pose.yaw - T_map_robot.yaw)) * 180.0 / kPi;
    const double shift = norm(pose.position() - T_map_robot.position()) / resolution_;
    const double value =
        fit(pose) - kPriceOfTurn * turn_deg / params_.align_deg - kPriceOfShift * shift;
    if (value > best_fit) {
      best_fit = value;
      best = pose;
    }
  };
  // The turn, which moves most, then the place; then both once more and finer.
  for (const double share : {1.0, 0.5}) {
    const double step_rad = share * kTurn_deg * kPi / 180.0;
    const int turns = share < 1.0 ? 3 : static_cast<int>(params_.align_deg / kTurn_deg);
    const Pose2 before = best;
    for (int i = -turns; i <= turns; ++i) {
      consider({before.x, before.y, before.yaw + i * step_rad});
    }
    const Pose2 at = best;
    const double step_m = share * kShift * resolution_;
    for (int i = -kShifts; i <= kShifts; ++i) {
      for (int j = -kShifts; j <= kShifts; ++j) {
        consider({at.x + i * step_m, at.y + j * step_m, at.yaw});
      }
    }
  }
  return best;
}

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

LocalOccupancy RollingMap::fuse(LocalOccupancy look, const Pose2& T_odom_robot) {
  // The square of the look fits into the window however it is turned.
  const int window = static_cast<int>(std::ceil(std::sqrt(2.0) * look.size)) + 2;
  const bool is_first = known_.width() != window || resolution_ != look.resolution;
  if (is_first) {
    known_ = Grid<Known>{window, window};
    resolution_ = look.resolution;
    T_map_odom_ = {};
  }
  Pose2 T_map_robot = T_map_odom_ * T_odom_robot;
  if (!is_first && params_.align_deg > 0.0) {
    T_map_robot = aligned(look, T_map_robot);
    T_map_odom_ = T_map_robot * inverse(T_odom_robot);
  }
  const Cell here = cell_at(T_map_robot.position(), resolution_);
  if (is_first) {
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
  const Transform to_robot{inverse(T_map_robot)};
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
      Known& known = known_({column, row});
      if (news > kPresumed || (news > 0.0F && known.confidence == 0.0F)) {
        known.occupancy = (known.occupancy * known.confidence + look.occupancy[i] * news) /
                          (known.confidence + news);
        known.confidence =
            std::min(known.confidence + news, static_cast<float>(params_.most_looks));
      }
    }
  }

  const Transform to_map{T_map_robot};
  const int corner_x = wrapped(middle_.x - reach, window);
  const int corner_y = wrapped(middle_.y - reach, window);
  for (int iy = 0; iy < look.size; ++iy) {
    for (int ix = 0; ix < look.size; ++ix) {
      const std::size_t i = look.index_of(ix, iy);
      const Cell c = cell_at(
          to_map({(ix + 0.5 - half) * resolution_, (iy + 0.5 - half) * resolution_}), resolution_);
      // Within the window, so that no division is needed to wrap it.
      const int x = corner_x + c.x - (middle_.x - reach);
      const int y = corner_y + c.y - (middle_.y - reach);
      const Known& known = known_({x < window ? x : x - window, y < window ? y : y - window});
      if (known.confidence > 0.0F) {
        look.occupancy[i] = known.occupancy;
        look.confidence[i] = known.confidence;
      }
    }
  }
  return look;
}

}  // namespace cmn
