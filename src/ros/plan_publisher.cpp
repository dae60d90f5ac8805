// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/plan_publisher.hpp"

#include "coarse_map_nav/planning/map_repair.hpp"
#include "coarse_map_nav/ros/conversions.hpp"

#include <utility>

namespace cmn {

PlanPublisher::PlanPublisher(ros::NodeHandle& nh, std::string map_frame)
    : map_frame_{std::move(map_frame)},
      status_pub_{nh.advertise<coarse_map_nav::NavigationStatus>("status", 5, true)},
      path_pub_{nh.advertise<nav_msgs::Path>("path", 1, true)},
      repaired_pub_{nh.advertise<nav_msgs::OccupancyGrid>("repaired_map", 1, true)} {}

void PlanPublisher::publish_status(const Decision& decision, double confidence,
                                   const Planner* planner) {
  std_msgs::Header header;
  header.stamp = ros::Time::now();
  header.frame_id = map_frame_;
  status_pub_.publish(message_of(decision, confidence, planner, header));
}

void PlanPublisher::publish_plan(const Planner& planner, Cell from, const CoarseMap& map,
                                 const std_msgs::Header& header) {
  path_pub_.publish(message_of(planner.path_from(from), map, header));
  const RepairedMap* const repaired = planner.repaired_map();
  if (repaired == nullptr || repaired_pub_.getNumSubscribers() == 0) {
    return;
  }
  CoarseMap now = repaired->as_map();
  if (repaired_ && is_same_drawing(*repaired_, now)) {
    return;
  }
  nav_msgs::OccupancyGrid grid = grid_message(now);
  grid.header = header;
  repaired_pub_.publish(grid);
  repaired_ = std::move(now);
}

}  // namespace cmn
