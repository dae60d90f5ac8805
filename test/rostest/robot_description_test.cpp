// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// simulation.launch: the robot's transforms are those of its URDF, each from one publisher.
#include "coarse_map_nav/simulation/robot_description.hpp"

#include <map>
#include <set>
#include <string>

#include "ros_graph.hpp"
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

namespace cmn {
namespace {

TEST(RobotDescriptionInTf, EveryLinkIsWhereTheUrdfSays) {
  const RobotDescription robot = read_robot_description(CMN_SOURCE_DIR "/urdf/locobot.urdf");
  tf2_ros::Buffer tf;
  tf2_ros::TransformListener listener{tf};
  for (const auto& [link, T_root_link] : robot.T_root_link) {
    SCOPED_TRACE(link);
    ASSERT_TRUE(
        wait_for([&, &link = link] { return tf.canTransform("odom", link, ros::Time{0}); }));
    const auto told = tf.lookupTransform(robot.root, link, ros::Time{0}).transform;
    const Eigen::Isometry3d T =
        Eigen::Translation3d{told.translation.x, told.translation.y, told.translation.z} *
        Eigen::Quaterniond{told.rotation.w, told.rotation.x, told.rotation.y, told.rotation.z};
    EXPECT_TRUE(T.isApprox(T_root_link, 1e-6)) << T.matrix();
  }
}

TEST(RobotDescriptionInTf, ScansComeFromTheLink) {
  Inbox<sensor_msgs::LaserScan> scans{"scan"};
  ASSERT_TRUE(wait_for([&] { return !scans.empty(); }));
  EXPECT_EQ(scans.back().header.frame_id, "laser");
}

TEST(RobotDescriptionInTf, EachLinkHasOneParentAndOnePublisher) {
  std::map<std::string, std::set<std::string>> origins;  // of each frame: node and parent
  const auto count = [&](const ros::MessageEvent<const tf2_msgs::TFMessage>& event) {
    for (const auto& transform : event.getConstMessage()->transforms) {
      origins[transform.child_frame_id].insert(event.getPublisherName() + " " +
                                               transform.header.frame_id);
    }
  };
  ros::NodeHandle nh;
  const ros::Subscriber moving =
      nh.subscribe<tf2_msgs::TFMessage, const ros::MessageEvent<const tf2_msgs::TFMessage>&>(
          "/tf", 100, count);
  const ros::Subscriber fixed =
      nh.subscribe<tf2_msgs::TFMessage, const ros::MessageEvent<const tf2_msgs::TFMessage>&>(
          "/tf_static", 100, count);
  ASSERT_TRUE(wait_for([&] {
    return origins.count("laser") == 1 && origins.count("base_footprint") == 1 &&
           origins.count("odom") == 1;
  }));
  for (const auto& [frame, from] : origins) {
    EXPECT_EQ(from.size(), 1U) << frame << ": " << *from.begin() << ", " << *from.rbegin();
  }
  EXPECT_EQ(*origins["laser"].begin(), "/robot_state_publisher lidar_tower_link");
  EXPECT_EQ(*origins["base_footprint"].begin(), "/simulator odom");
}

}  // namespace
}  // namespace cmn
