// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/rolling_map.hpp"

#include "coarse_map_nav/data/look_contradiction.hpp"
#include "coarse_map_nav/data/whole_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>

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
constexpr double kMostKnown = 0.5;  ///< of surfaces()
constexpr double kRounding = 1e-9;
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

/// Whole numbers from `first` to `last`; none where `last` is less.
struct Range {
  int first;
  int last;
};

Range together(Range a, Range b) { return {std::max(a.first, b.first), std::min(a.last, b.last)}; }

/// All k for which `start` + k * `step` lies in [0, size), and up to two more at either end.
Range within(double start, double step, int size) {
  constexpr int kFar = 1 << 20;
  if (std::abs(step) * kFar < size) {
    return {-kFar, kFar};
  }
  const double a = -start / step;
  const double b = (size - start) / step;
  return {whole_below(std::max(std::min(a, b), -1.0 * kFar)) - 1,
          whole_below(std::min(std::max(a, b), 1.0 * kFar)) + 1};
}

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

void RollingMap::forget() {
  occupancy_ = {};
  confidence_ = {};
}

Cell RollingMap::place_of(Cell c) const {
  const int size = confidence_.width();
  return {wrapped(c.x, size), wrapped(c.y, size)};
}

cv::Mat RollingMap::surfaces() const {
  const int size = confidence_.width();
  cv::Mat image(size, size, CV_32F);
  const Cell corner = middle_ - Cell{size / 2, size / 2};
  for (int y = 0; y < size; ++y) {
    const Cell first = place_of(corner + Cell{0, y});
    const float* occupancy = &occupancy_({0, first.y});
    const float* confidence = &confidence_({0, first.y});
    const auto copy = [&](int from, int to, float* out) {
      for (int x = from; x < to; ++x) {
        const float above = occupancy[x] - 0.5F;  // read in any case: no branch
        out[x - from] = confidence[x] > 0.0F ? above : 0.0F;
      }
    };
    copy(first.x, size, image.ptr<float>(y));
    copy(0, first.x, image.ptr<float>(y) + (size - first.x));
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
  // Mean of what is known where the surface would lie, between the middles of cells; less than
  // `least`, and whatever, once it cannot be as much any more.
  const auto fit = [&](const Pose2& pose, double least) {
    const Transform to_map{pose};
    const auto points = static_cast<double>(surface.size());
    double sum = 0.0;
    double most = kMostKnown * points;
    for (const Point2 p_robot : surface) {
      if (most < least * points) {
        return -kMostKnown;
      }
      const double before = sum;
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
      most -= kMostKnown - (sum - before);
    }
    return sum / points;
  };
  Pose2 best = T_map_robot;
  double best_fit = fit(best, -kMostKnown);
  const auto consider = [&](const Pose2& pose) {
    const double turn_deg = std::abs(wrap_angle(pose.yaw - T_map_robot.yaw)) * 180.0 / kPi;
    const double shift = norm(pose.position() - T_map_robot.position()) / resolution_;
    const double price = kPriceOfTurn * turn_deg / params_.align_deg + kPriceOfShift * shift;
    const double value = fit(pose, best_fit + price - kRounding) - price;
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
  const int size = confidence_.width();
  const int half = size / 2;
  const Cell by = middle - middle_;
  if (std::abs(by.x) >= size || std::abs(by.y) >= size) {
    std::fill(confidence_.values().begin(), confidence_.values().end(), 0.0F);
  } else {
    // Columns, then rows that come into the window.
    for (int i = 0; i < std::abs(by.x); ++i) {
      const int x = by.x > 0 ? middle_.x + size - half + i : middle_.x - half - 1 - i;
      for (int y = 0; y < size; ++y) {
        confidence_({wrapped(x, size), y}) = 0.0F;
      }
    }
    for (int i = 0; i < std::abs(by.y); ++i) {
      const int y = by.y > 0 ? middle_.y + size - half + i : middle_.y - half - 1 - i;
      for (int x = 0; x < size; ++x) {
        confidence_({x, wrapped(y, size)}) = 0.0F;
      }
    }
  }
  middle_ = middle;
}

void RollingMap::age(double driven_m) {
  const auto keeps = static_cast<float>(std::exp(-driven_m / params_.memory_m));
  for (float& confidence : confidence_.values()) {
    const float now = confidence * keeps;
    confidence = now < kForgotten ? 0.0F : now;
  }
}

void RollingMap::fold_in(const LocalOccupancy& look, const Pose2& T_map_robot) {
  const int window = confidence_.width();
  const int reach = window / 2;
  const auto most_looks = static_cast<float>(params_.most_looks);
  // In cells of the look, from its corner: of the middle of the window, and a cell farther.
  const Transform to_robot{inverse(T_map_robot)};
  const double half = 0.5 * look.size;
  const Point2 origin =
      (1.0 / resolution_) * to_robot(resolution_ * middle_of(middle_)) + Point2{half, half};
  const Point2 along = turned(Point2{1.0, 0.0}, -T_map_robot.yaw);
  for (int dy = -reach; dy < reach; ++dy) {
    const Point2 first{origin.x - dy * along.y, origin.y + dy * along.x};
    const Range in_look = together(
        {-reach, reach - 1},
        together(within(first.x, along.x, look.size), within(first.y, along.y, look.size)));
    const Cell place = place_of(middle_ + Cell{in_look.first, dy});
    float* occupancy = &occupancy_({0, place.y});
    float* confidence = &confidence_({0, place.y});
    for (int dx = in_look.first, x = place.x; dx <= in_look.last; ++dx, ++x) {
      x = x == window ? 0 : x;
      const Point2 p{first.x + dx * along.x, first.y + dx * along.y};
      if (p.x < 0.0 || p.y < 0.0 || p.x >= look.size || p.y >= look.size) {
        continue;
      }
      const std::size_t i = look.index_of(static_cast<int>(p.x), static_cast<int>(p.y));
      const float news = look.confidence[i];
      if (news > kPresumed || (news > 0.0F && confidence[x] == 0.0F)) {
        const float before = confidence[x] > 0.0F ? confidence[x] * occupancy[x] : 0.0F;
        occupancy[x] = (before + look.occupancy[i] * news) / (confidence[x] + news);
        confidence[x] = std::min(confidence[x] + news, most_looks);
      }
    }
  }
}

LocalOccupancy RollingMap::all_known(LocalOccupancy look, const Pose2& T_map_robot) const {
  const int window = confidence_.width();
  // In cells of the window, from its corner.
  const Cell corner = middle_ - Cell{window / 2, window / 2};
  const Cell place = place_of(corner);
  const double half = 0.5 * look.size - 0.5;
  const Point2 along = turned(Point2{1.0, 0.0}, T_map_robot.yaw);
  const Point2 first = (1.0 / resolution_) * T_map_robot.position() -
                       Point2{static_cast<double>(corner.x), static_cast<double>(corner.y)} -
                       Point2{half * (along.x - along.y), half * (along.x + along.y)};
  for (int iy = 0; iy < look.size; ++iy) {
    const Point2 row{first.x - iy * along.y, first.y + iy * along.x};
    for (int ix = 0; ix < look.size; ++ix) {
      // Within the window, so neither is below 0.
      const int x = place.x + static_cast<int>(row.x + ix * along.x);
      const int y = place.y + static_cast<int>(row.y + ix * along.y);
      const std::size_t there =
          confidence_.index_of({x < window ? x : x - window, y < window ? y : y - window});
      const std::size_t i = look.index_of(ix, iy);
      const bool is_known = confidence_[there] > 0.0F;
      look.occupancy[i] = is_known ? occupancy_[there] : look.occupancy[i];
      look.confidence[i] = is_known ? confidence_[there] : look.confidence[i];
    }
  }
  return look;
}

LocalOccupancy RollingMap::fuse(LocalOccupancy look, const Pose2& T_odom_robot) {
  // The square of the look fits into the window however it is turned.
  const int window = static_cast<int>(std::ceil(std::sqrt(2.0) * look.size)) + 2;
  const bool is_first =
      confidence_.width() != window || resolution_ != look.resolution ||
      contradiction(last_, look, inverse(T_odom_last_) * T_odom_robot) > params_.carried_share;
  if (is_first) {
    occupancy_ = {window, window};
    confidence_ = {window, window};
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
    age(norm(T_odom_robot.position() - T_odom_last_.position()));
  }
  T_odom_last_ = T_odom_robot;
  fold_in(look, T_map_robot);
  last_ = all_known(std::move(look), T_map_robot);
  return last_;
}

}  // namespace cmn
