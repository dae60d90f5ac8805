// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/belief_publisher.hpp"

#include "coarse_map_nav/Belief.h"
#include "coarse_map_nav/ros/conversions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <visualization_msgs/MarkerArray.h>

namespace cmn {
namespace {

constexpr std::array<const char*, 4> kLayerNames{"belief/east", "belief/north", "belief/west",
                                                 "belief/south"};

/// Probabilities as the cells of an occupancy grid: 1 to 98, the greatest of them 98. rviz's
/// costmap colours run from blue to red over that range and leave 0 clear.
std::int8_t shade_of(double probability, double greatest) {
  // The square root lets second-best places show beside a sharp peak.
  const double share = greatest > 0.0 ? std::sqrt(probability / greatest) : 0.0;
  return static_cast<std::int8_t>(std::lround(98.0 * share));
}

}  // namespace

BeliefPublisher::BeliefPublisher(ros::NodeHandle& nh, std::string map_frame)
    : map_frame_{std::move(map_frame)} {
  belief_pub_ = nh.advertise<coarse_map_nav::Belief>("belief", 1, true);
  for (std::size_t k = 0; k < kLayerNames.size(); ++k) {
    layer_pubs_[k] = nh.advertise<nav_msgs::OccupancyGrid>(kLayerNames[k], 1, true);
  }
  marginal_pub_ = nh.advertise<nav_msgs::OccupancyGrid>("belief/marginal", 1, true);
  pose_pub_ = nh.advertise<geometry_msgs::PoseWithCovarianceStamped>("pose", 1, true);
  hypotheses_pub_ = nh.advertise<visualization_msgs::MarkerArray>("hypotheses", 1, true);
}

void BeliefPublisher::place_layers(const CoarseMap& map) {
  // To the right of the map, two by two, a tenth of its size apart.
  const double across = 1.1 * map.width() * map.resolution();
  const double up = 1.1 * map.height() * map.resolution();
  const std::array<Point2, 4> places{Point2{across, 0.0}, Point2{2.0 * across, 0.0},
                                     Point2{across, -up}, Point2{2.0 * across, -up}};
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (std::size_t k = 0; k < kLayerNames.size(); ++k) {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = ros::Time::now();
    transform.header.frame_id = map_frame_;
    transform.child_frame_id = kLayerNames[k];
    transform.transform = transform_message({places[k].x, places[k].y, 0.0});
    transforms.push_back(transform);
  }
  static_tf_.sendTransform(transforms);
}

void BeliefPublisher::publish(const BeliefFilter& filter, std::uint32_t action_id,
                              const ros::Time& stamp) {
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header.frame_id = map_frame_;
  pose.header.stamp = stamp;
  pose.pose.pose = pose_message(filter.T_map_robot());
  const Spread spread = spread_about(filter.belief(), filter.estimate());
  const double square = filter.map().resolution() * filter.map().resolution();
  pose.pose.covariance[0] = square * spread.xx;
  pose.pose.covariance[1] = pose.pose.covariance[6] = square * spread.xy;
  pose.pose.covariance[7] = square * spread.yy;
  pose.pose.covariance[35] = spread.yaw;
  pose_pub_.publish(pose);

  coarse_map_nav::Belief belief = message_of(filter.belief(), filter.map());
  belief.header = pose.header;
  belief.entropy = static_cast<float>(entropy(filter.belief()));
  belief.confidence = static_cast<float>(filter.confidence());
  belief.converged = static_cast<std::uint8_t>(filter.is_converged());
  belief.estimate = pose.pose.pose;
  belief.action_id = action_id;
  belief_pub_.publish(belief);

  publish_grids(filter, stamp);
  publish_hypotheses(filter, stamp);
}

void BeliefPublisher::publish_grids(const BeliefFilter& filter, const ros::Time& stamp) {
  nav_msgs::OccupancyGrid grid;
  grid.header.stamp = stamp;
  grid.info = info_of(filter.map());
  grid.data.resize(filter.map().occupied().size());
  const double greatest = filter.estimate().probability;
  for (const Heading h : kHeadings) {
    const auto k = static_cast<std::size_t>(index(h));
    if (layer_pubs_[k].getNumSubscribers() > 0) {
      grid.header.frame_id = kLayerNames[k];
      for (std::size_t i = 0; i < grid.data.size(); ++i) {
        const double p = filter.belief()(h, filter.map().occupied().cell_at(i));
        grid.data[i] = filter.map().occupied()[i] != 0 ? 100 : shade_of(p, greatest);
      }
      layer_pubs_[k].publish(grid);
    }
  }
  if (marginal_pub_.getNumSubscribers() > 0) {
    grid.header.frame_id = map_frame_;
    const Grid<double> p = marginal(filter.belief());
    const double most = *std::max_element(p.values().begin(), p.values().end());
    for (std::size_t i = 0; i < grid.data.size(); ++i) {
      grid.data[i] = shade_of(p[i], most);
    }
    marginal_pub_.publish(grid);
  }
}

void BeliefPublisher::publish_hypotheses(const BeliefFilter& filter, const ros::Time& stamp) {
  if (hypotheses_pub_.getNumSubscribers() == 0) {
    return;
  }
  visualization_msgs::MarkerArray array;
  visualization_msgs::Marker marker;
  marker.header.frame_id = map_frame_;
  marker.header.stamp = stamp;
  marker.ns = "hypotheses";
  marker.action = visualization_msgs::Marker::DELETEALL;
  array.markers.push_back(marker);
  marker.action = visualization_msgs::Marker::ADD;
  marker.type = visualization_msgs::Marker::ARROW;
  for (const Estimate& e : best_hypotheses(filter.belief(), 12, 2)) {
    const double share = std::sqrt(e.probability / filter.estimate().probability);
    const Point2 p = filter.map().center_of(e.cell);
    marker.id = static_cast<int>(array.markers.size());
    marker.pose = pose_message({p.x, p.y, yaw(e.heading) + filter.map().T_map_grid().yaw});
    marker.pose.position.z = 0.1;
    marker.scale.x = std::max(0.1, 1.2 * share);
    marker.scale.y = marker.scale.z = std::max(0.03, 0.2 * share);
    marker.color.r = 0.85F;
    marker.color.g = 0.1F;
    marker.color.b = 0.45F;
    marker.color.a = static_cast<float>(0.3 + 0.7 * share);
    array.markers.push_back(marker);
  }
  hypotheses_pub_.publish(array);
}

}  // namespace cmn
