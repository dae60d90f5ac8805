// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/described_mounts.hpp"

#include <stdexcept>

#include <ros/param.h>

namespace cmn {

SensorMounts described_mounts(const std::string& base, const SensorFrameParams& frames) {
  std::string key;
  std::string xml;
  if (!ros::param::search("robot_description", key) || !ros::param::get(key, xml)) {
    throw std::runtime_error(
        "robot_description: there is no such parameter; launch/include/robot.launch sets it");
  }
  return mounts_of(parse_robot_description(xml, key), base, frames);
}

}  // namespace cmn
