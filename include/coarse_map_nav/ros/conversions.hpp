// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Messages <-> core types. Whatever can be malformed comes back as an optional and a reason.
#pragma once

#include "coarse_map_nav/Belief.h"
#include "coarse_map_nav/DiscreteAction.h"
#include "coarse_map_nav/LocalOccupancy.h"
#include "coarse_map_nav/MotionResult.h"
#include "coarse_map_nav/NavigationStatus.h"
#include "coarse_map_nav/data/action.hpp"
#include "coarse_map_nav/data/belief.hpp"
#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/localization.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"
#include "coarse_map_nav/planning/planner.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>
#include <nav_msgs/MapMetaData.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Header.h>

namespace cmn {

geometry_msgs::Quaternion quaternion_of(double yaw_rad);
/// The yaw of a quaternion that need not be normalised; empty when it is no rotation (zero, NaN).
std::optional<double> yaw_of(const geometry_msgs::Quaternion& q);
geometry_msgs::Pose pose_message(const Pose2& pose);
std::optional<Pose2> pose_of(const geometry_msgs::Pose& pose);
geometry_msgs::Transform transform_message(const Pose2& pose);
std::optional<Pose2> pose_of(const geometry_msgs::Transform& transform);

nav_msgs::MapMetaData info_of(const CoarseMap& map);
/// 0 free, 100 occupied.
nav_msgs::OccupancyGrid grid_message(const CoarseMap& map);
/// Values in [0, 50) are free, all others (unknown, -1, too) occupied. Empty, and `why` says what
/// is wrong, for sizes that disagree, a resolution or origin that is none, no free cell.
std::optional<CoarseMap> map_of(const nav_msgs::OccupancyGrid& grid, std::string& why);

coarse_map_nav::LocalOccupancy message_of(const LocalOccupancy& local, const std_msgs::Header& h);
/// For rviz: 0 to 100, -1 where nothing is known. The middle 6 m at most: a larger square would
/// hide the drawing.
nav_msgs::OccupancyGrid grid_message(const LocalOccupancy& local, const std_msgs::Header& header);
std::optional<LocalOccupancy> local_occupancy_of(const coarse_map_nav::LocalOccupancy& msg,
                                                 std::string& why);

/// What is wrong with a scan as a whole; empty when it can be used. Bad single ranges are no fault.
std::string fault_of(const sensor_msgs::LaserScan& scan);
RangeScan scan_of(const sensor_msgs::LaserScan& scan, const Pose2& T_robot_sensor);

/// A localization as the planner gets it, with a belief of its own.
struct ReceivedBelief {
  Belief belief;
  Estimate estimate;
  Point2 position_cells;
  double yaw_rad = 0.0;
  double confidence = 0.0;
  bool is_converged = false;
  double scale = 1.0;
  double axes_yaw_rad = 0.0;
  /// Good as long as this is. `looks`: what the localizer expects to see, which no message tells.
  Localization localization(const ExpectedLooks* looks = nullptr) const {
    return {belief,       estimate, position_cells, yaw_rad, confidence,
            is_converged, scale,    axes_yaw_rad,   nullptr, looks};
  }
};
/// All but header and action_id.
coarse_map_nav::Belief message_of(const Localization& at, const CoarseMap& map);
/// Empty, and `why` says so, when the message does not fit the map or holds no distribution.
std::optional<ReceivedBelief> belief_of(const coarse_map_nav::Belief& msg, const CoarseMap& map,
                                        std::string& why);

coarse_map_nav::DiscreteAction message_of(const Action& action, std::uint32_t id,
                                          const std_msgs::Header& header);
coarse_map_nav::MotionResult message_of(const MotionResult& result, const std_msgs::Header& header);
/// `planner`: whose actions and pivots it counts; null before there is one.
coarse_map_nav::NavigationStatus message_of(const Decision& decision, double confidence,
                                            const Planner* planner, const std_msgs::Header& header);
/// The middles of cells.
nav_msgs::Path message_of(const std::vector<Cell>& path, const CoarseMap& map,
                          const std_msgs::Header& header);
/// Stamped by the header: the scan's own time counts from the simulation's start.
sensor_msgs::LaserScan message_of(const RangeScan& scan, const std_msgs::Header& header,
                                  double period_s);

}  // namespace cmn
