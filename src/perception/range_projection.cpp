// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/range_projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cmn {
namespace {

/// The beam nearest to a bearing in the sensor's frame; -1 when none is within half an increment.
std::int32_t nearest_beam(const RangeScan& scan, std::size_t beams, double bearing_rad) {
  const double step = std::abs(scan.angle_increment_rad);
  if (beams == 0 || !(step > 0.0) || !std::isfinite(step) || !std::isfinite(scan.angle_min_rad)) {
    return -1;
  }
  const double sense = scan.angle_increment_rad > 0.0 ? 1.0 : -1.0;
  double past_first = std::fmod(sense * (bearing_rad - scan.angle_min_rad), 2.0 * kPi);
  past_first += past_first < 0.0 ? 2.0 * kPi : 0.0;
  const auto beam = static_cast<std::int64_t>(std::llround(past_first / step));
  if (beam < static_cast<std::int64_t>(beams)) {
    return static_cast<std::int32_t>(beam);
  }
  return 2.0 * kPi - past_first <= 0.5 * step ? 0 : -1;
}

/// Of a sensor that looks down at a slant: true for ground that it would look at from the robot's
/// middle, and misses only because it sits farther ahead.
bool is_between(const RangeScan& scan, std::size_t beams, Point2 p_robot) {
  constexpr double kNear_m = 0.5;
  const double bearing = std::atan2(p_robot.y, p_robot.x) - scan.T_robot_sensor.yaw;
  return !scan.sights.empty() && norm(p_robot) < kNear_m && nearest_beam(scan, beams, bearing) >= 0;
}

bool is_usable(float range_m, const RangeScan& scan) {
  return range_m >= static_cast<float>(scan.range_min_m) && range_m >= 0.0F;
}

/// How far a beam that met nothing was free. Between two that hit it was lost, and is no slit in a
/// wall: as far as the nearer of them. (Where beams are far apart it may well be a door.)
float free_range_m(const RangeScan& scan, std::size_t beam) {
  constexpr double kDense_rad = 2.0 * kPi / 180.0;
  const std::size_t beams = scan.ranges_m.size();
  const auto range_max_m = static_cast<float>(scan.range_max_m);
  const float sight_m = scan.sights.empty() ? range_max_m : scan.sights[beam].to_m;
  const double step_rad = std::abs(scan.angle_increment_rad);
  const bool is_closed = step_rad * static_cast<double>(beams) > 2.0 * kPi - kDense_rad;
  const bool has_neighbours = beams > 2 && (is_closed || (beam > 0 && beam + 1 < beams));
  if (!has_neighbours || step_rad > kDense_rad) {
    return sight_m;
  }
  const float before_m = scan.ranges_m[(beam + beams - 1) % beams];
  const float after_m = scan.ranges_m[(beam + 1) % beams];
  const auto has_hit = [&](float range_m) {
    return is_usable(range_m, scan) && range_m <= range_max_m;
  };
  return has_hit(before_m) && has_hit(after_m) ? std::min({before_m, after_m, sight_m}) : sight_m;
}

}  // namespace

void RangeProjector::tabulate(const RangeScan& scan) {
  layout_ = scan;
  layout_.ranges_m.clear();
  layout_beams_ = scan.ranges_m.size();
  const double cell_m = params_.side_m / params_.size;
  const Pose2 T_sensor_robot = inverse(scan.T_robot_sensor);
  bearings_.clear();
  const auto no_beam = static_cast<std::uint32_t>(layout_beams_);
  for (int iy = 0; iy < params_.size; ++iy) {
    for (int ix = 0; ix < params_.size; ++ix) {
      const Point2 p_robot{(ix + 0.5 - 0.5 * params_.size) * cell_m,
                           (iy + 0.5 - 0.5 * params_.size) * cell_m};
      const Point2 p = T_sensor_robot * p_robot;
      const std::int32_t beam = nearest_beam(scan, layout_beams_, std::atan2(p.y, p.x));
      const bool is_presumed = beam < 0 && is_between(scan, layout_beams_, p_robot);
      bearings_.push_back({beam >= 0 ? static_cast<std::uint32_t>(beam) : no_beam + is_presumed,
                           static_cast<float>(norm(p))});
    }
  }
}

LocalOccupancy RangeProjector::project(const RangeScan& scan, BeamCount* count) {
  const bool same_layout = layout_beams_ == scan.ranges_m.size() && !bearings_.empty() &&
                           layout_.angle_min_rad == scan.angle_min_rad &&
                           layout_.angle_increment_rad == scan.angle_increment_rad &&
                           layout_.T_robot_sensor.x == scan.T_robot_sensor.x &&
                           layout_.T_robot_sensor.y == scan.T_robot_sensor.y &&
                           layout_.T_robot_sensor.yaw == scan.T_robot_sensor.yaw &&
                           layout_.sights.empty() == scan.sights.empty();
  if (!same_layout) {
    tabulate(scan);
  }

  // Per beam: free below `hit_m`, seen to be so from `from_m` on; seen to be occupied up to
  // `behind_m`, not seen beyond; NaN compares false.
  struct Beam {
    float from_m;
    float hit_m;
    float behind_m;
    float occupancy;  ///< from hit_m on
  };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto range_max_m = static_cast<float>(scan.range_max_m);
  const double diagonal_m = std::sqrt(2.0) * params_.side_m / params_.size;
  const auto wall_m = static_cast<float>(std::max(params_.wall_m, diagonal_m));
  std::vector<Beam> beams;
  beams.reserve(scan.ranges_m.size() + 2);
  BeamCount seen;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const float range_m = scan.ranges_m[i];
    const float from_m = scan.sights.empty() ? 0.0F : scan.sights[i].from_m;
    if (!is_usable(range_m, scan)) {
      beams.push_back({0.0F, kNan, kNan, 0.5F});
      ++seen.unusable;
    } else if (range_m > range_max_m) {
      beams.push_back({from_m, free_range_m(scan, i), -kInfinity, 0.5F});
      ++seen.used;
    } else {
      beams.push_back({from_m, range_m, range_m + wall_m, 1.0F});
      ++seen.used;
    }
  }
  beams.push_back({0.0F, kNan, kNan, 0.5F});                  // of the bearings without one
  beams.push_back({kInfinity, kInfinity, -kInfinity, 0.5F});  // and of what is_between
  if (count != nullptr) {
    *count = seen;
  }

  LocalOccupancy local{params_.size, params_.side_m / params_.size};
  local.stamp_s = scan.stamp_s;
  local.source = scan.source;
  float* occupancy = local.occupancy.data();
  float* confidence = local.confidence.data();
  const Bearing* bearings = bearings_.data();
  for (std::size_t i = 0; i < bearings_.size(); ++i) {
    const Beam& beam = beams[bearings[i].beam];
    const float range_m = bearings[i].range_m;
    const bool is_free = range_m < beam.hit_m;
    occupancy[i] = is_free ? 0.0F : beam.occupancy;
    const auto was_seen = static_cast<float>(is_free | (range_m <= beam.behind_m));
    confidence[i] = is_free && range_m < beam.from_m ? kPresumed : was_seen;
  }
  return local;
}

}  // namespace cmn
