// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/rolling_map.hpp"

#include "coarse_map_nav/data/look_contradiction.hpp"
#include "coarse_map_nav/data/whole_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr float kForgotten = 0.05F;
constexpr double kAnchorWay_m = 0.6;  ///< see Anchor

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

}  // namespace

void RollingMap::forget() {
  occupancy_ = {};
  confidence_ = {};
}

std::optional<HeadingDrift> RollingMap::heading_drift() const {
  return params_.align.enabled && first_stamp_s_
             ? std::optional<HeadingDrift>{{-T_map_odom_.yaw, *first_stamp_s_}}
             : std::nullopt;
}

Cell RollingMap::place_of(Cell c) const {
  const int size = confidence_.width();
  return {wrapped(c.x, size), wrapped(c.y, size)};
}

cv::Mat1b RollingMap::anchored_surface() const {
  const int size = anchor_.width();
  cv::Mat1b free(size, size);
  cv::Mat1b standing(size, size);
  const Cell corner = middle_ - Cell{size / 2, size / 2};
  for (int y = 0; y < size; ++y) {
    const Cell first = place_of(corner + Cell{0, y});
    const Anchor* const row = &anchor_({0, first.y});
    for (int x = 0; x < size; ++x) {
      const Anchor here = row[first.x + x < size ? first.x + x : first.x + x - size];
      free(y, x) = static_cast<std::uint8_t>(here == Anchor::kFree);
      standing(y, x) = static_cast<std::uint8_t>(here == Anchor::kStanding);
    }
  }
  cv::Mat1b beside_free;
  cv::dilate(free, beside_free, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
  return standing.mul(beside_free);
}

void RollingMap::anchor(double driven_m) {
  since_anchor_m_ += driven_m;
  const bool is_due = since_anchor_m_ >= kAnchorWay_m;
  since_anchor_m_ = is_due ? 0.0 : since_anchor_m_;
  for (std::size_t i = 0; i < anchor_.size(); ++i) {
    const bool is_known = confidence_[i] > 0.0F;
    const Anchor now = !is_known              ? Anchor::kNone
                       : occupancy_[i] > 0.5F ? Anchor::kStanding
                                              : Anchor::kFree;
    anchor_[i] = is_due || !is_known || anchor_[i] == Anchor::kNone ? now : anchor_[i];
  }
}

void RollingMap::scroll_to(Cell middle) {
  const int size = confidence_.width();
  const int half = size / 2;
  const Cell by = middle - middle_;
  const auto clear = [this](Cell c) {
    confidence_(c) = 0.0F;
    anchor_(c) = Anchor::kNone;
  };
  if (std::abs(by.x) >= size || std::abs(by.y) >= size) {
    std::fill(confidence_.values().begin(), confidence_.values().end(), 0.0F);
    std::fill(anchor_.values().begin(), anchor_.values().end(), Anchor::kNone);
  } else {
    // Columns, then rows that come into the window.
    for (int i = 0; i < std::abs(by.x); ++i) {
      const int x = by.x > 0 ? middle_.x + size - half + i : middle_.x - half - 1 - i;
      for (int y = 0; y < size; ++y) {
        clear({wrapped(x, size), y});
      }
    }
    for (int i = 0; i < std::abs(by.y); ++i) {
      const int y = by.y > 0 ? middle_.y + size - half + i : middle_.y - half - 1 - i;
      for (int x = 0; x < size; ++x) {
        clear({x, wrapped(y, size)});
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
  first_stamp_s_ = first_stamp_s_.value_or(look.stamp_s);
  // The square of the look fits into the window however it is turned.
  const int window = static_cast<int>(std::ceil(std::sqrt(2.0) * look.size)) + 2;
  const bool is_first =
      confidence_.width() != window || resolution_ != look.resolution ||
      contradiction(last_, look, inverse(T_odom_last_) * T_odom_robot) > params_.carried_share;
  if (is_first) {
    occupancy_ = {window, window};
    confidence_ = {window, window};
    anchor_ = {window, window};
    resolution_ = look.resolution;
  }
  Pose2 T_map_robot = T_map_odom_ * T_odom_robot;
  if (!is_first && params_.align.enabled) {
    const int half = window / 2;
    T_map_robot =
        align_look(surface_of(look), anchored_surface(), middle_of(middle_ - Cell{half, half}),
                   resolution_, T_map_robot, T_map_odom_ * T_odom_last_, params_.align);
    T_map_odom_ = T_map_robot * inverse(T_odom_robot);
  }
  const double driven_m = is_first ? 0.0 : norm(T_odom_robot.position() - T_odom_last_.position());
  const Cell here = cell_at(T_map_robot.position(), resolution_);
  if (is_first) {
    middle_ = here;
  } else {
    scroll_to(here);
    age(driven_m);
  }
  T_odom_last_ = T_odom_robot;
  fold_in(look, T_map_robot);
  if (params_.align.enabled) {
    anchor(driven_m);
  }
  last_ = all_known(std::move(look), T_map_robot);
  return last_;
}

}  // namespace cmn
