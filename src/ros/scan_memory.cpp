// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/scan_memory.hpp"

#include "coarse_map_nav/ros/tf_lookup.hpp"

#include <cmath>

namespace cmn {

std::optional<RangeScan> ScanMemory::at(const ros::Time& stamp, std::string& why) const {
  if (!last_ || std::abs(last_->stamp_s - stamp.toSec()) > kSameTime_s) {
    why = "no scan of about the same time";
    return std::nullopt;
  }
  const auto then = lookup(buffer_, frames_.odom, frames_.base, ros::Time(last_->stamp_s), why);
  const auto now = lookup(buffer_, frames_.odom, frames_.base, stamp, why);
  if (!then || !now) {
    return std::nullopt;
  }
  RangeScan scan = *last_;
  scan.T_robot_sensor = inverse(*now) * *then * scan.T_robot_sensor;
  return scan;
}

}  // namespace cmn
