// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A recorded log as a rosbag that the nodes can be run on.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/evaluation/carmen_log.hpp"
#include "coarse_map_nav/evaluation/odometry_noise.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace cmn {

struct CarmenBagOptions {
  Pose2 T_world_log;  ///< turns the log so that the building's main walls lie along the axes
  OdometryNoiseParams noise;
  std::uint32_t seed = 1;
};

/// What went into the bag.
struct CarmenBagSummary {
  std::size_t scans = 0;
  std::size_t poses = 0;
  double duration_s = 0.0;
  double path_m = 0.0;
  Pose2 drift;  ///< from where the robot really ended to where the odometry says so
};

/// Logs that begin earlier are moved to begin here [s]: nodes subtract durations from the present,
/// and a ros::Time cannot be negative.
constexpr double kEarliestBagTime_s = 1000.0;

/// Writes, with the times of the log:
///
///     scan          sensor_msgs/LaserScan    frame laser; +inf where a beam met nothing (REP-117)
///     odom          nav_msgs/Odometry        odom -> base_link, with drift
///     ground_truth  nav_msgs/Odometry        world -> base_link, as the log has it
///     /tf           odom -> base_link        with every odom message
///     /tf_static    base_link -> laser       latched
///
/// The scan of a pose follows that pose's odometry. Throws rosbag::BagException.
CarmenBagSummary write_carmen_bag(const CarmenLog& log, const CarmenBagOptions& options,
                                  const std::string& path);

}  // namespace cmn
