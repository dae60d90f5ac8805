// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A belief in all the forms that others want it in.
#pragma once

#include "coarse_map_nav/Belief.h"
#include "coarse_map_nav/localization/localizer.hpp"

#include <array>
#include <cstdint>
#include <string>

#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

namespace cmn {

/// Publishes `belief`, its layers and marginal as occupancy grids for rviz, `pose` (as amcl does,
/// covariance included) and `hypotheses`, all latched.
///
/// The layers are pictures for rviz, beside the map and reduced: cell for cell those of the map, in
/// frames of their own (`belief/east` and so on, below the map frame), labelled by `belief/labels`.
class BeliefPublisher {
 public:
  BeliefPublisher(ros::NodeHandle& nh, std::string map_frame);

  /// Where rviz is to show the layers of a map of this size.
  void place_layers(const CoarseMap& map);
  /// Stamps everything with `stamp`.
  void publish(const Localizer& localizer, std::uint32_t action_id, const ros::Time& stamp);
  /// Sends the last `belief` again as it was.
  void repeat() { belief_pub_.publish(belief_); }

 private:
  void publish_grids(const Localization& at, const CoarseMap& map, const ros::Time& stamp);
  void publish_hypotheses(const Localization& at, const CoarseMap& map, const ros::Time& stamp);

  std::string map_frame_;
  coarse_map_nav::Belief belief_;  ///< the last one published
  ros::Publisher belief_pub_;
  std::array<ros::Publisher, 4> layer_pubs_;
  ros::Publisher labels_pub_;
  ros::Publisher marginal_pub_;
  ros::Publisher pose_pub_;
  ros::Publisher hypotheses_pub_;
  tf2_ros::StaticTransformBroadcaster static_tf_;
};

}  // namespace cmn
