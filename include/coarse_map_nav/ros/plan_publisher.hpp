// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the planner tells people about its plan.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/planning/planner.hpp"

#include <optional>
#include <string>
#include <vector>

#include <ros/ros.h>
#include <std_msgs/Header.h>

namespace cmn {

/// Publishes `status`, `path` and `repaired_map`, all latched.
class PlanPublisher {
 public:
  PlanPublisher(ros::NodeHandle& nh, std::string map_frame);

  /// `planner`: that decided; null before there is one.
  void publish_status(const Decision& decision, double confidence, const Planner* planner);
  /// Path and repaired map, both stamped as the belief that they follow from. The map only when it
  /// is another one than before and somebody listens.
  void publish_plan(const Planner& planner, Cell from, const CoarseMap& map,
                    const std_msgs::Header& header);

 private:
  std::string map_frame_;
  ros::Publisher status_pub_;
  ros::Publisher path_pub_;
  ros::Publisher repaired_pub_;
  std::optional<CoarseMap> repaired_;
};

}  // namespace cmn
