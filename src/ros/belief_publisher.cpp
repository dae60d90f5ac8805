// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/belief_publisher.hpp"

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

// Beside the map, the layers are as high as it together.
constexpr double kGap = 0.04;  // of the map's height
constexpr double kLayerScale = (1.0 - 3.0 * kGap) / 4.0;

/// Probabilities as the cells of an occupancy grid, the greatest of them 98. rviz's costmap colours
/// run from blue to red over 1 to 98 and leave 0 clear, which is what is left of less than a
/// hundredth of the greatest.
std::int8_t shade_of(double probability, double greatest) {
  // The square root lets second-best places show beside a sharp peak.
  const double share = greatest > 0.0 ? std::sqrt(probability / greatest) : 0.0;
  return share < 0.1 ? std::int8_t{0} : static_cast<std::int8_t>(std::lround(98.0 * share));
}

/// An arrow and a name for a layer, about `center`, in lines of `line_m`.
std::array<visualization_msgs::Marker, 2> label_of(Heading h, Point2 center, double line_m) {
  visualization_msgs::Marker text;
  text.ns = "labels";
  text.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  text.pose = pose_message({center.x, center.y - line_m, 0.0});
  text.scale.z = line_m;
  text.color.r = text.color.g = text.color.b = 0.25F;
  text.color.a = 1.0F;
  text.text = std::string{kLayerNames[static_cast<std::size_t>(index(h))]}.substr(7);
  visualization_msgs::Marker arrow = text;
  arrow.type = visualization_msgs::Marker::ARROW;
  const Point2 tail = Point2{center.x, center.y + 0.7 * line_m} - turned({line_m, 0.0}, yaw(h));
  arrow.pose = pose_message({tail.x, tail.y, yaw(h)});
  arrow.scale.x = 2.0 * line_m;
  arrow.scale.y = arrow.scale.z = 0.4 * line_m;
  return {arrow, text};
}

}  // namespace

BeliefPublisher::BeliefPublisher(ros::NodeHandle& nh, std::string map_frame)
    : map_frame_{std::move(map_frame)} {
  belief_pub_ = nh.advertise<coarse_map_nav::Belief>("belief", 1, true);
  for (std::size_t k = 0; k < kLayerNames.size(); ++k) {
    layer_pubs_[k] = nh.advertise<nav_msgs::OccupancyGrid>(kLayerNames[k], 1, true);
  }
  labels_pub_ = nh.advertise<visualization_msgs::MarkerArray>("belief/labels", 1, true);
  marginal_pub_ = nh.advertise<nav_msgs::OccupancyGrid>("belief/marginal", 1, true);
  pose_pub_ = nh.advertise<geometry_msgs::PoseWithCovarianceStamped>("pose", 1, true);
  hypotheses_pub_ = nh.advertise<visualization_msgs::MarkerArray>("hypotheses", 1, true);
}

void BeliefPublisher::place_layers(const CoarseMap& map) {
  const double width = map.width() * map.resolution();
  const double height = map.height() * map.resolution();
  const double gap = kGap * height;
  std::vector<geometry_msgs::TransformStamped> transforms;
  visualization_msgs::MarkerArray labels;
  for (const Heading h : kHeadings) {
    const char* const name = kLayerNames[static_cast<std::size_t>(index(h))];
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = ros::Time::now();
    transform.header.frame_id = map_frame_;
    transform.child_frame_id = name;
    const double y = (1.0 - kLayerScale) * height - index(h) * (kLayerScale * height + gap);
    transform.transform = transform_message(map.T_map_grid() * Pose2{width + gap, y, 0.0});
    transforms.push_back(transform);
    const Point2 right{kLayerScale * width + 1.8 * gap, 0.5 * kLayerScale * height};
    for (visualization_msgs::Marker& marker : label_of(h, right, gap)) {
      marker.header = transform.header;
      marker.header.frame_id = name;
      marker.id = static_cast<int>(labels.markers.size());
      labels.markers.push_back(marker);
    }
  }
  static_tf_.sendTransform(transforms);
  labels_pub_.publish(labels);
}

void BeliefPublisher::publish(const Localizer& localizer, std::uint32_t action_id,
                              const ros::Time& stamp) {
  const Localization at = localizer.localization();
  const CoarseMap& map = localizer.map();
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header.frame_id = map_frame_;
  pose.header.stamp = stamp;
  pose.pose.pose = pose_message(pose_in_map(map, at));
  const Spread spread = spread_about(at.belief, at.estimate);
  const double square = map.resolution() * map.resolution();
  pose.pose.covariance[0] = square * spread.xx;
  pose.pose.covariance[1] = pose.pose.covariance[6] = square * spread.xy;
  pose.pose.covariance[7] = square * spread.yy;
  pose.pose.covariance[35] = spread.yaw;
  pose_pub_.publish(pose);

  belief_ = message_of(at, map);
  belief_.header = pose.header;
  belief_.action_id = action_id;
  belief_pub_.publish(belief_);

  publish_grids(at, map, stamp);
  publish_hypotheses(at, map, stamp);
}

void BeliefPublisher::publish_grids(const Localization& at, const CoarseMap& map,
                                    const ros::Time& stamp) {
  nav_msgs::OccupancyGrid grid;
  grid.header.stamp = stamp;
  grid.info = info_of(map);
  grid.info.resolution *= static_cast<float>(kLayerScale);
  grid.info.origin = pose_message({});  // the layers' frames lie at their corners
  grid.data.resize(map.occupied().size());
  const double greatest = at.estimate.probability;
  for (const Heading h : kHeadings) {
    const auto k = static_cast<std::size_t>(index(h));
    grid.header.frame_id = kLayerNames[k];
    for (std::size_t i = 0; i < grid.data.size(); ++i) {
      const double p = at.belief(h, map.occupied().cell_at(i));
      grid.data[i] = map.occupied()[i] != 0 ? -1 : shade_of(p, greatest);
    }
    layer_pubs_[k].publish(grid);
  }
  grid.header.frame_id = map_frame_;
  grid.info = info_of(map);
  const Grid<double> p = marginal(at.belief);
  const double most = *std::max_element(p.values().begin(), p.values().end());
  for (std::size_t i = 0; i < grid.data.size(); ++i) {
    grid.data[i] = shade_of(p[i], most);
  }
  marginal_pub_.publish(grid);
}

void BeliefPublisher::publish_hypotheses(const Localization& at, const CoarseMap& map,
                                         const ros::Time& stamp) {
  visualization_msgs::MarkerArray array;
  visualization_msgs::Marker marker;
  marker.header.frame_id = map_frame_;
  marker.header.stamp = stamp;
  marker.ns = "hypotheses";
  marker.action = visualization_msgs::Marker::DELETEALL;
  array.markers.push_back(marker);
  marker.action = visualization_msgs::Marker::ADD;
  marker.type = visualization_msgs::Marker::ARROW;
  for (const Estimate& e : best_hypotheses(at.belief, 12, 2)) {
    const double share = std::sqrt(e.probability / at.estimate.probability);
    const Point2 p = map.center_of(e.cell);
    marker.id = static_cast<int>(array.markers.size());
    marker.pose = pose_message({p.x, p.y, yaw(e.heading) + map.T_map_grid().yaw});
    marker.pose.position.z = 0.05;  // above what rviz draws of the map
    marker.scale.x = std::max(0.1, 1.2 * share);
    marker.scale.y = marker.scale.z = std::max(0.03, 0.2 * share);
    marker.color.r = 1.0F;
    marker.color.g = 0.72F;
    marker.color.b = 0.0F;
    marker.color.a = static_cast<float>(0.3 + 0.7 * share);
    array.markers.push_back(marker);
  }
  hypotheses_pub_.publish(array);
}

}  // namespace cmn
