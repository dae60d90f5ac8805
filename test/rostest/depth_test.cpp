// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/LocalOccupancy.h"
#include "coarse_map_nav/ros/conversions.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "box_room.hpp"
#include "depth_images.hpp"
#include "robot_transforms.hpp"
#include "ros_graph.hpp"
#include <gtest/gtest.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Float32.h>

namespace cmn {
namespace {

const CameraModel kCamera = CameraModel::from_field_of_view(160, 120, 1.5);
const Eigen::Isometry3d kMount = camera_mount(0.1, 0.5, 0.2);
/// 1.5 m ahead of a robot that faces east.
const std::vector<Box> kWall{{{1.5, -9.0, 0.0}, {1.6, 9.0, 2.0}}};

/// A perception node with a depth camera in front of it.
class DepthTest : public testing::Test {
 protected:
  void start(const std::string& source, const std::string& accumulate) {
    node_ = std::make_unique<NodeProcess>(
        "perception", std::vector<std::string>{"_perception/source:=" + source,
                                               "_perception/accumulate:=" + accumulate,
                                               "_perception/local_occupancy/side_m:=6.0",
                                               "_perception/local_occupancy/size:=60",
                                               "_perception/guard/type:=footprint"});
    ASSERT_TRUE(wait_for([this] {
      return images_.getNumSubscribers() > 0 && infos_.getNumSubscribers() > 0 &&
             clouds_.getNumSubscribers() > 0 && observe_.getNumSubscribers() > 0 &&
             local_.is_connected() && clear_.is_connected() && diagnostics_.is_connected();
    })) << node_->output();
  }
  void TearDown() override {
    node_.reset();
    ros::param::del("/perception");
  }

  static sensor_msgs::Image image_at(const Pose2& T_odom_robot) {
    const DepthImage depth = depth_of_boxes(kWall, kCamera, kMount, T_odom_robot);
    sensor_msgs::Image image;
    image.header.stamp = ros::Time::now();
    image.header.frame_id = "camera";
    image.width = static_cast<std::uint32_t>(kCamera.width);
    image.height = static_cast<std::uint32_t>(kCamera.height);
    image.encoding = "32FC1";
    image.step = 4 * image.width;
    image.data.assign(depth.depth_m.data, depth.depth_m.data + image.step * image.height);
    return image;
  }
  static sensor_msgs::CameraInfo camera_info() {
    sensor_msgs::CameraInfo info;
    info.header.frame_id = "camera";
    info.width = static_cast<std::uint32_t>(kCamera.width);
    info.height = static_cast<std::uint32_t>(kCamera.height);
    info.K = {kCamera.fx, 0.0, kCamera.cx, 0.0, kCamera.fy, kCamera.cy, 0.0, 0.0, 1.0};
    return info;
  }
  static sensor_msgs::PointCloud2 cloud_at(const Pose2& T_odom_robot) {
    const DepthImage depth = depth_of_boxes(kWall, kCamera, kMount, T_odom_robot);
    sensor_msgs::PointCloud2 cloud;
    cloud.header.stamp = ros::Time::now();
    cloud.header.frame_id = "camera";
    cloud.width = static_cast<std::uint32_t>(kCamera.width);
    cloud.height = static_cast<std::uint32_t>(kCamera.height);
    cloud.point_step = 16;
    cloud.row_step = 16 * cloud.width;
    for (const char* name : {"x", "y", "z"}) {
      sensor_msgs::PointField field;
      field.name = name;
      field.offset = static_cast<std::uint32_t>(4 * cloud.fields.size());
      field.datatype = sensor_msgs::PointField::FLOAT32;
      field.count = 1;
      cloud.fields.push_back(field);
    }
    cloud.data = cloud_bytes_of(depth, 16);
    return cloud;
  }

  /// Sends images of one pose until one of them is answered by a look that holds `is_it`.
  template <class Predicate>
  void look_until(const Pose2& T_odom_robot, Predicate&& is_it) {
    local_.clear();
    ASSERT_TRUE(wait_for([&] {
      infos_.publish(camera_info());
      const sensor_msgs::Image image = image_at(T_odom_robot);
      transforms_.send_odometry(image.header.stamp, T_odom_robot);
      images_.publish(image);
      wait_for([] { return false; }, 0.05);  // a camera has a rate
      return !local_.empty() && is_it(local_.back());
    })) << node_->output();
  }
  template <class Message>
  void expect_drop(ros::Publisher& publisher, const Message& message, const std::string& reason) {
    SCOPED_TRACE(reason);
    const auto count = [&] {
      return diagnosed(diagnostics_, "perception: depth", "dropped: " + reason);
    };
    const double before = count();
    Message now = message;
    EXPECT_TRUE(wait_for([&] {
      now.header.stamp = ros::Time::now();
      transforms_.send_odometry(now.header.stamp, {});
      publisher.publish(now);
      return wait_for([&] { return count() > before; }, 0.3);
    })) << node_->output();
  }

  static float occupancy_at(const coarse_map_nav::LocalOccupancy& local, double x, double y) {
    std::string why;
    const auto seen = local_occupancy_of(local, why);
    return seen ? seen->occupancy[seen->index_of(
                      static_cast<int>(std::floor(x / seen->resolution)) + seen->size / 2,
                      static_cast<int>(std::floor(y / seen->resolution)) + seen->size / 2)]
                : NAN;
  }

  ros::NodeHandle nh_;
  ros::Publisher images_ = nh_.advertise<sensor_msgs::Image>("depth/image", 10);
  ros::Publisher infos_ = nh_.advertise<sensor_msgs::CameraInfo>("camera_info", 10);
  ros::Publisher clouds_ = nh_.advertise<sensor_msgs::PointCloud2>("points", 10);
  ros::Publisher scans_ = nh_.advertise<sensor_msgs::LaserScan>("scan", 10);
  ros::Publisher observe_ = nh_.advertise<std_msgs::Empty>("observe", 1);
  RobotTransforms transforms_;
  Inbox<coarse_map_nav::LocalOccupancy> local_{"local_occupancy"};
  Inbox<std_msgs::Float32> clear_{"clear_ahead"};
  Inbox<sensor_msgs::Image> panoramas_{"panorama"};
  Inbox<diagnostic_msgs::DiagnosticArray> diagnostics_{"/diagnostics"};
  std::unique_ptr<NodeProcess> node_;
};

TEST_F(DepthTest, BadInputIsDroppedAndCountedAndTheNextGoodOneIsUsed) {
  start("depth", "none");
  // Without transforms everything waits, and the queue overflows.
  ASSERT_TRUE(wait_for([&] {
    sensor_msgs::Image image = image_at({});
    image.header.frame_id = "nowhere";
    images_.publish(image);
    wait_for([] { return false; }, 0.02);
    return diagnosed(diagnostics_, "perception: depth",
                     "dropped: no transform from nowhere to base_link and odom at its time") > 0;
  })) << node_->output();
  EXPECT_TRUE(local_.empty());
  EXPECT_TRUE(clear_.empty()) << "nobody knows what is ahead";

  transforms_.mount_sensors(kMount);
  expect_drop(images_, image_at({}), "the depth image has no camera_info yet");
  sensor_msgs::CameraInfo info = camera_info();
  info.K[0] = 0.0;
  infos_.publish(info);
  expect_drop(images_, image_at({}), "camera_info is of no camera: it is not calibrated");
  info = camera_info();
  info.width = 80;
  infos_.publish(info);
  expect_drop(images_, image_at({}), "the depth image is of another size than camera_info");
  infos_.publish(camera_info());
  sensor_msgs::Image image = image_at({});
  image.encoding = "rgb8";
  expect_drop(images_, image, "the depth image is \"rgb8\", neither 16UC1 nor 32FC1");
  image = image_at({});
  image.data.resize(100);
  expect_drop(images_, image, "the depth image has fewer bytes than pixels");
  sensor_msgs::PointCloud2 cloud = cloud_at({});
  cloud.fields.clear();
  expect_drop(clouds_, cloud, "the cloud has no field x");
  cloud = cloud_at({});
  cloud.is_bigendian = 1;
  expect_drop(clouds_, cloud, "the cloud is big-endian");
  cloud = cloud_at({});
  cloud.data.resize(100);
  expect_drop(clouds_, cloud, "the cloud has fewer bytes than points");
  EXPECT_TRUE(local_.empty());

  look_until({}, [](const auto& local) { return occupancy_at(local, 1.55, 0.0) == 1.0F; });
  EXPECT_EQ(occupancy_at(local_.back(), 1.35, 0.0), 0.0F);
  EXPECT_EQ(local_.back().source, coarse_map_nav::LocalOccupancy::SOURCE_DEPTH);
  EXPECT_EQ(local_.back().partial, 0);
  EXPECT_NEAR(local_.back().clear_ahead, 1.5 - 0.17, 0.05);
  for (const auto& local : local_.all()) {
    for (std::size_t i = 0; i < local->occupancy.size(); ++i) {
      ASSERT_TRUE(std::isfinite(local->occupancy[i]) && std::isfinite(local->confidence[i]));
    }
  }
}

TEST_F(DepthTest, AnImageWaitsForItsTransformAndACloudIsAsGood) {
  start("depth", "rolling");
  transforms_.mount_sensors(kMount);
  look_until({}, [](const auto& /*local*/) { return true; });
  local_.clear();
  sensor_msgs::PointCloud2 cloud = cloud_at({});
  clouds_.publish(cloud);
  EXPECT_FALSE(wait_for([this] { return !local_.empty(); }, 0.3)) << "odometry is still to come";
  transforms_.send_odometry(cloud.header.stamp + ros::Duration(0.01), {});
  ASSERT_TRUE(wait_for([this] { return !local_.empty(); })) << node_->output();
  EXPECT_EQ(local_.back().header.stamp, cloud.header.stamp);
  EXPECT_GT(occupancy_at(local_.back(), 1.55, 0.0), 0.5F);
}

TEST_F(DepthTest, APanoramaIsPartialUntilTheRobotHasTurnedRoundAtRest) {
  start("depth", "panorama");
  transforms_.mount_sensors(kMount);
  for (int turn = 0; turn < 4; ++turn) {
    SCOPED_TRACE(turn);
    look_until({0.0, 0.0, turn * kPi / 2.0}, [](const auto& local) { return local.partial != 0; });
    EXPECT_TRUE(panoramas_.empty());
  }
  // Under way nothing is looked at, but the guard goes on.
  local_.clear();
  clear_.clear();
  for (int i = 0; i < 10; ++i) {
    const Pose2 pose{0.0, 0.0, 3.0 * kPi / 2.0 + 0.1 * i};
    const sensor_msgs::Image image = image_at(pose);
    transforms_.send_odometry(image.header.stamp, pose);
    images_.publish(image);
    wait_for([] { return false; }, 0.03);
  }
  ASSERT_TRUE(wait_for([this] { return clear_.size() >= 5; })) << node_->output();
  EXPECT_LE(local_.size(), 1U);
  look_until({}, [](const auto& local) { return local.partial == 0; });
  EXPECT_EQ(occupancy_at(local_.back(), 1.55, 0.0), 1.0F) << "the wall";
  EXPECT_EQ(occupancy_at(local_.back(), -1.55, 0.0), 0.0F) << "seen on the way round";
  ASSERT_TRUE(wait_for([this] { return !panoramas_.empty(); })) << node_->output();
  EXPECT_EQ(panoramas_.back().width, 4U * 160U);
  EXPECT_EQ(panoramas_.back().height, 120U);
  EXPECT_EQ(panoramas_.back().encoding, "bgr8");
  look_until({0.0, 0.0, kPi / 2.0}, [](const auto& local) { return local.partial == 0; });
  look_until({0.3, 0.0, kPi / 2.0}, [](const auto& local) { return local.partial != 0; });
}

TEST_F(DepthTest, FusedTheLidarGuardsAndSeesWhatIsBehindTheCamera) {
  start("fused", "none");
  transforms_.mount_sensors(kMount);
  sensor_msgs::LaserScan scan;
  scan.header.frame_id = "laser";
  scan.angle_min = static_cast<float>(-kPi);
  scan.angle_increment = static_cast<float>(2.0 * kPi / 360.0);
  scan.range_max = 8.0F;
  scan.ranges.assign(360, 2.0F);
  expect_drop(images_, image_at({}), "the depth image has no camera_info yet");
  infos_.publish(camera_info());
  expect_drop(images_, image_at({}), "no scan of about the same time");
  EXPECT_TRUE(clear_.empty());
  ASSERT_TRUE(wait_for([&] {
    sensor_msgs::Image image = image_at({});
    scan.header.stamp = image.header.stamp;
    transforms_.send_odometry(image.header.stamp, {});
    scans_.publish(scan);
    wait_for([] { return false; }, 0.05);
    images_.publish(image);
    return wait_for([this] { return !local_.empty(); }, 0.2);
  })) << node_->output();
  EXPECT_EQ(local_.back().source, coarse_map_nav::LocalOccupancy::SOURCE_FUSED);
  EXPECT_EQ(occupancy_at(local_.back(), 1.55, 0.0), 1.0F) << "the wall that the camera sees";
  EXPECT_EQ(occupancy_at(local_.back(), -2.05, 0.0), 1.0F) << "what the LiDAR sees behind";
  EXPECT_NEAR(local_.back().clear_ahead, 2.0 - 0.17, 0.02) << "the LiDAR's word";
}

}  // namespace
}  // namespace cmn
