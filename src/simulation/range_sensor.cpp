// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/simulation/range_sensor.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

namespace cmn {

RangeSensor::RangeSensor(const LidarParams& params, std::uint32_t seed, const Pose2& T_robot_sensor)
    : params_{params}, rng_{seed} {
  const double view_rad = params.field_of_view_deg * kPi / 180.0;
  // All round, the last beam would fall on the first.
  const int gaps = params.field_of_view_deg >= 360.0 ? params.beams : params.beams - 1;
  layout_.angle_min_rad = -view_rad / 2.0;
  layout_.angle_increment_rad = view_rad / gaps;
  layout_.range_min_m = params.range_min_m;
  layout_.range_max_m = params.range_max_m;
  layout_.T_robot_sensor = T_robot_sensor;
  for (int i = 0; i < params.beams; ++i) {
    const double bearing_rad = layout_.angle_min_rad + i * layout_.angle_increment_rad;
    directions_.push_back({std::cos(bearing_rad), std::sin(bearing_rad)});
  }
}

RangeScan RangeSensor::measure(const World& world, const Pose2& T_world_robot, double stamp_s) {
  const Pose2 T_world_sensor = T_world_robot * layout_.T_robot_sensor;
  const double c = std::cos(T_world_sensor.yaw);
  const double s = std::sin(T_world_sensor.yaw);
  std::vector<double> ranges_m;
  ranges_m.reserve(directions_.size());
  for (const Point2 d : directions_) {
    ranges_m.push_back(world.cast(T_world_sensor.position(), {c * d.x - s * d.y, s * d.x + c * d.y},
                                  params_.range_max_m));
  }
  return read(ranges_m, layout_.T_robot_sensor, stamp_s);
}

RangeScan RangeSensor::read(const std::vector<double>& true_ranges_m, const Pose2& T_robot_sensor,
                            double stamp_s) {
  RangeScan scan = layout_;
  scan.stamp_s = stamp_s;
  scan.T_robot_sensor = T_robot_sensor;
  scan.ranges_m.reserve(true_ranges_m.size());
  for (const double range_m : true_ranges_m) {
    scan.ranges_m.push_back(read(range_m));
  }
  return scan;
}

float RangeSensor::read(double true_range_m) {
  const float lost = params_.dropout_value == "nan" ? std::numeric_limits<float>::quiet_NaN()
                                                    : std::numeric_limits<float>::infinity();
  if (uniform_(rng_) < params_.dropout) {
    return lost;
  }
  if (std::isinf(true_range_m)) {
    return std::numeric_limits<float>::infinity();
  }
  const double range_m =
      true_range_m + (params_.noise_m + params_.noise_share * true_range_m) * normal_(rng_);
  if (range_m < params_.range_min_m) {
    return lost;
  }
  return range_m > params_.range_max_m ? std::numeric_limits<float>::infinity()
                                       : static_cast<float>(range_m);
}

}  // namespace cmn
