// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/carmen_bag.hpp"

#include "coarse_map_nav/ros/conversions.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

namespace cmn {
namespace {

/// A robot that drives 2 m along the log's x axis, in a world turned by 90 degrees.
class CarmenBag : public testing::Test {
 protected:
  CarmenBag() {
    std::string text;
    for (int i = 0; i <= 20; ++i) {
      const std::string x = std::to_string(0.1 * i);
      const std::string t = std::to_string(0.5 * i);
      text += "ODOM " + x + " 0 0 0 0 0 " + t + " h " + t + "\n";
      if (i % 5 == 0) {
        text += "FLASER 5 1 2 81 4 x " + x + " 0 0 " + x + " 0 0 " + t + " h " + t + "\n";
      }
    }
    CarmenBagOptions options;
    options.T_world_log = {10.0, 20.0, kPi / 2.0};
    options.noise = {0.0, 0.0, 0.0, 0.1, 0.0};
    summary_ = write_carmen_bag(parse_carmen_log(text), options, path_);
  }
  ~CarmenBag() override { std::filesystem::remove(path_); }

  template <class Message>
  std::vector<Message> messages(const std::string& topic) const {
    const rosbag::Bag bag{path_};
    std::vector<Message> all;
    for (const rosbag::MessageInstance& m : rosbag::View{bag, rosbag::TopicQuery{topic}}) {
      all.push_back(*m.instantiate<Message>());
      EXPECT_EQ(m.getTime(), all.back().header.stamp);
    }
    return all;
  }

  const std::string path_ =
      (std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "_carmen.bag"))
          .string();
  CarmenBagSummary summary_;
};

TEST_F(CarmenBag, HoldsEveryPoseAndScanOnItsTopic) {
  const rosbag::Bag bag{path_};
  std::map<std::string, int> counts;
  for (const rosbag::MessageInstance& m : rosbag::View{bag}) {
    ++counts[m.getTopic()];
  }
  const std::map<std::string, int> expected{
      {"scan", 5}, {"odom", 21}, {"ground_truth", 21}, {"/tf", 21}, {"/tf_static", 1}};
  EXPECT_EQ(counts, expected);
  EXPECT_EQ(summary_.scans, 5U);
  EXPECT_EQ(summary_.poses, 21U);
  EXPECT_NEAR(summary_.path_m, 2.0, 1e-9);
  EXPECT_NEAR(summary_.duration_s, 10.0, 1e-9);
}

TEST_F(CarmenBag, ScansCoverTheHalfCircleAheadAndMarkNoReturns) {
  const auto scans = messages<sensor_msgs::LaserScan>("scan");
  ASSERT_EQ(scans.size(), 5U);
  const auto& scan = scans[1];
  EXPECT_EQ(scan.header.frame_id, "laser");
  EXPECT_NEAR(scan.header.stamp.toSec(), kEarliestBagTime_s + 2.5, 1e-6);
  EXPECT_NEAR(scan.angle_min, -kPi / 2.0, 1e-6);
  EXPECT_NEAR(scan.angle_min + 4 * scan.angle_increment, scan.angle_max, 1e-6);
  EXPECT_EQ(scan.ranges[0], 1.0F);
  EXPECT_TRUE(std::isinf(scan.ranges[2]));
  EXPECT_TRUE(std::isnan(scan.ranges[4]));
  EXPECT_EQ(fault_of(scan), "") << "perception must take it";
}

TEST_F(CarmenBag, TruthIsInTheWorldAndOdometryDrifts) {
  const auto truth = messages<nav_msgs::Odometry>("ground_truth");
  const auto odom = messages<nav_msgs::Odometry>("odom");
  ASSERT_EQ(truth.size(), 21U);
  ASSERT_EQ(odom.size(), 21U);
  EXPECT_EQ(truth[0].header.frame_id, "world");
  EXPECT_EQ(truth[0].child_frame_id, "base_link");
  EXPECT_EQ(odom[0].header.frame_id, "odom");
  const auto end = pose_of(truth.back().pose.pose);
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->x, 10.0, 1e-9);
  EXPECT_NEAR(end->y, 22.0, 1e-9);
  EXPECT_NEAR(end->yaw, kPi / 2.0, 1e-9);
  EXPECT_NEAR(truth[1].twist.twist.linear.x, 0.2, 1e-6) << "0.1 m in 0.5 s";
  const auto said = pose_of(odom.back().pose.pose);
  ASSERT_TRUE(said);
  EXPECT_NEAR(said->yaw, 0.0, 1e-9) << "the odometry does not know the quarter";
  EXPECT_GT(std::abs(said->x - 2.0), 0.001);
  EXPECT_NEAR(summary_.drift.x, said->x - 2.0, 1e-9);
}

TEST_F(CarmenBag, TransformsGoFromOdometryToTheLaser) {
  const rosbag::Bag bag{path_};
  bool is_latched = false;
  std::vector<std::string> links;
  const std::vector<std::string> topics{"/tf", "/tf_static"};
  for (const rosbag::MessageInstance& m : rosbag::View{bag, rosbag::TopicQuery{topics}}) {
    const auto& transform = m.instantiate<tf2_msgs::TFMessage>()->transforms.at(0);
    links.push_back(transform.header.frame_id + ">" + transform.child_frame_id);
    is_latched = is_latched || (m.getTopic() == "/tf_static" && m.isLatching());
  }
  EXPECT_TRUE(is_latched);
  EXPECT_EQ(std::count(links.begin(), links.end(), "base_link>laser"), 1);
  EXPECT_EQ(std::count(links.begin(), links.end(), "odom>base_link"), 21);
}

}  // namespace
}  // namespace cmn
