// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/carmen_bag.hpp"

#include "coarse_map_nav/ros/conversions.hpp"

#include <algorithm>
#include <vector>

#include <boost/make_shared.hpp>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/message_traits.h>
#include <rosbag/bag.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

namespace cmn {
namespace {

constexpr char kOdomFrame[] = "odom";
constexpr char kBaseFrame[] = "base_link";
constexpr char kLaserFrame[] = "laser";
constexpr char kWorldFrame[] = "world";

tf2_msgs::TFMessage tf_message(const ros::Time& stamp, const char* parent, const char* child,
                               const Pose2& T_parent_child) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform = transform_message(T_parent_child);
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  return message;
}

/// `step`: the motion since the message before, `period_s` ago.
nav_msgs::Odometry odometry_message(const ros::Time& stamp, const char* frame, const Pose2& pose,
                                    const Pose2& step, double period_s) {
  nav_msgs::Odometry message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.child_frame_id = kBaseFrame;
  message.pose.pose = pose_message(pose);
  message.twist.twist.linear.x = step.x / period_s;
  message.twist.twist.linear.y = step.y / period_s;
  message.twist.twist.angular.z = step.yaw / period_s;
  return message;
}

sensor_msgs::LaserScan scan_message(const ros::Time& stamp, const CarmenScan& scan) {
  sensor_msgs::LaserScan message;
  message.header.stamp = stamp;
  message.header.frame_id = kLaserFrame;
  message.angle_min = static_cast<float>(-kPi / 2.0);
  message.angle_max = static_cast<float>(kPi / 2.0);
  message.angle_increment = static_cast<float>(kPi / static_cast<double>(scan.ranges_m.size() - 1));
  message.range_min = 0.0F;
  message.range_max = static_cast<float>(kCarmenMaxRange_m);
  message.ranges = scan.ranges_m;
  return message;
}

/// The header of a connection whose last message a player sends to late subscribers.
boost::shared_ptr<ros::M_string> latched_header(const tf2_msgs::TFMessage& message) {
  auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = ros::message_traits::datatype(message);
  (*header)["md5sum"] = ros::message_traits::md5sum(message);
  (*header)["message_definition"] = ros::message_traits::definition(message);
  (*header)["latching"] = "1";
  (*header)["callerid"] = "/carmen_to_bag";
  return header;
}

}  // namespace

CarmenBagSummary write_carmen_bag(const CarmenLog& log, const CarmenBagOptions& options,
                                  const std::string& path) {
  std::vector<Pose2> truth;
  for (const CarmenPose& pose : log.poses) {
    truth.push_back(options.T_world_log * pose.T_log_robot);
  }
  const std::vector<Pose2> odometry = drifting_odometry(truth, options.noise, options.seed);
  const double begin_s = log.poses.front().stamp_s;
  const double shift_s = std::max(0.0, kEarliestBagTime_s - begin_s);
  const auto time_of = [&](std::size_t i) { return ros::Time{log.poses[i].stamp_s + shift_s}; };

  rosbag::Bag bag{path, rosbag::bagmode::Write};
  bag.setCompression(rosbag::compression::LZ4);
  const auto mount = tf_message(time_of(0), kBaseFrame, kLaserFrame, {});
  bag.write("/tf_static", time_of(0), mount, latched_header(mount));

  CarmenBagSummary summary;
  auto scan = log.scans.begin();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const ros::Time time = time_of(i);
    const std::size_t before = i == 0 ? 0 : i - 1;
    const double period_s = i == 0 ? 1.0 : log.poses[i].stamp_s - log.poses[before].stamp_s;
    const Pose2 driven = inverse(truth[before]) * truth[i];
    const Pose2 said = inverse(odometry[before]) * odometry[i];
    bag.write("/tf", time, tf_message(time, kOdomFrame, kBaseFrame, odometry[i]));
    bag.write("odom", time, odometry_message(time, kOdomFrame, odometry[i], said, period_s));
    bag.write("ground_truth", time,
              odometry_message(time, kWorldFrame, truth[i], driven, period_s));
    summary.path_m += norm(driven.position());
    for (; scan != log.scans.end() && scan->pose == i; ++scan) {
      bag.write("scan", time, scan_message(time, *scan));
    }
  }
  bag.close();
  summary.scans = log.scans.size();
  summary.poses = log.poses.size();
  summary.duration_s = log.poses.back().stamp_s - begin_s;
  summary.drift = inverse(inverse(truth.front()) * truth.back()) *
                  (inverse(odometry.front()) * odometry.back());
  return summary;
}

}  // namespace cmn
