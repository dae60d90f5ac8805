// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/LocalOccupancy.h"
#include "coarse_map_nav/ros/conversions.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "ros_graph.hpp"
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Empty.h>
#include <tf2_ros/static_transform_broadcaster.h>

namespace cmn {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// A perception node and the LiDAR in front of it.
class Perception : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(wait_for([this] {
      return scans_.getNumSubscribers() > 0 && observe_.getNumSubscribers() > 0 &&
             local_.is_connected() && ahead_.is_connected() && diagnostics_.is_connected();
    })) << node_.output();
  }

  static sensor_msgs::LaserScan scan_of(float range_m, std::size_t beams = 360) {
    sensor_msgs::LaserScan scan;
    scan.header.stamp = ros::Time::now();
    scan.header.frame_id = "laser";
    scan.angle_min = static_cast<float>(-kPi);
    scan.angle_increment = static_cast<float>(2.0 * kPi / static_cast<double>(beams));
    scan.angle_max = static_cast<float>(kPi) - scan.angle_increment;
    scan.range_min = 0.05F;
    scan.range_max = 8.0F;
    scan.ranges.assign(beams, range_m);
    return scan;
  }

  void mount_laser(double yaw_rad = 0.0) {
    geometry_msgs::TransformStamped mount;
    mount.header.stamp = ros::Time::now();
    mount.header.frame_id = "base_link";
    mount.child_frame_id = "laser";
    mount.transform = transform_message({0.0, 0.0, yaw_rad});
    broadcaster_.sendTransform(mount);
    // Transforms come by a way of their own: send until the node has this one.
    ASSERT_TRUE(wait_for([this] {
      scans_.publish(scan_of(2.0F));
      return !local_.empty();
    })) << node_.output();
    look(scan_of(2.0F));  // the last of them
  }

  /// Sends a scan and waits for what is made of it.
  void look(const sensor_msgs::LaserScan& scan) {
    const auto is_answered = [&] {
      return !local_.empty() && local_.back().header.stamp == scan.header.stamp;
    };
    ahead_.clear();
    scans_.publish(scan);
    ASSERT_TRUE(wait_for([&] { return is_answered() && !ahead_.empty(); })) << node_.output();
  }

  bool has_nan() const {
    for (const auto& local : local_.all()) {
      for (std::size_t i = 0; i < local->occupancy.size(); ++i) {
        if (!std::isfinite(local->occupancy[i]) || !std::isfinite(local->confidence[i])) {
          return true;
        }
      }
    }
    return false;
  }

  double drops(const std::string& reason) const {
    return diagnosed(diagnostics_, "perception: scan", "dropped: " + reason);
  }

  ros::NodeHandle nh_;
  ros::Publisher scans_ = nh_.advertise<sensor_msgs::LaserScan>("scan", 10);
  ros::Publisher observe_ = nh_.advertise<std_msgs::Empty>("observe", 1);
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  Inbox<coarse_map_nav::LocalOccupancy> local_{"local_occupancy"};
  Inbox<std_msgs::Bool> ahead_{"obstacle_ahead"};
  Inbox<diagnostic_msgs::DiagnosticArray> diagnostics_{"/diagnostics"};
  NodeProcess node_{"perception"};
};

TEST_F(Perception, WithoutATransformScansAreDroppedAndCountedUntilItComes) {
  const std::string reason = "no transform from laser to base_link";
  ASSERT_TRUE(wait_for([&] {
    scans_.publish(scan_of(2.0F));
    return drops(reason) > 0;
  })) << node_.output();
  EXPECT_TRUE(local_.empty());
  EXPECT_TRUE(ahead_.empty()) << "nobody knows what is ahead";
  mount_laser();
  look(scan_of(2.0F));
}

TEST_F(Perception, MalformedScansAreDroppedAndCountedAndTheNextGoodOneIsUsed) {
  mount_laser();
  struct Fault {
    std::string reason;
    std::function<void(sensor_msgs::LaserScan&)> spoil;
  };
  const std::vector<Fault> faults{
      {"the scan has no ranges", [](auto& s) { s.ranges.clear(); }},
      {"the scan's angles are no angles", [](auto& s) { s.angle_min = kNan; }},
      {"the scan's angles are no angles", [](auto& s) { s.angle_increment = 0.0F; }},
      {"the scan's angles are no angles", [](auto& s) { s.angle_increment = kInf; }},
      {"the scan's range_min and range_max are no interval", [](auto& s) { s.range_max = -1.0F; }},
      {"the scan's range_min and range_max are no interval", [](auto& s) { s.range_min = kNan; }},
      {"no range of the scan is usable", [](auto& s) { s.ranges.assign(9, kNan); }},
      {"no range of the scan is usable", [](auto& s) { s.ranges.assign(9, -1.0F); }},
      {"no transform from nowhere to base_link", [](auto& s) { s.header.frame_id = "nowhere"; }},
      {"no transform from  to base_link", [](auto& s) { s.header.frame_id = ""; }},
  };
  local_.clear();
  std::size_t next = 0;
  const auto are_all_counted = [&] {
    sensor_msgs::LaserScan scan = scan_of(2.0F);
    faults[next++ % faults.size()].spoil(scan);
    scans_.publish(scan);
    return std::all_of(faults.begin(), faults.end(),
                       [this](const Fault& fault) { return drops(fault.reason) > 0; });
  };
  EXPECT_TRUE(wait_for(are_all_counted)) << node_.output();
  EXPECT_TRUE(local_.empty()) << "a bad one was used";
  look(scan_of(2.0F));
  EXPECT_FALSE(has_nan());
}

TEST_F(Perception, BadSingleRangesNeverReachTheOutput) {
  mount_laser();
  for (const float bad : {kNan, kInf, -kInf, -1.0F, 0.0F, 1e30F, 1e-30F}) {
    SCOPED_TRACE(bad);
    sensor_msgs::LaserScan scan = scan_of(0.5F);
    for (std::size_t i = 0; i < scan.ranges.size(); i += 2) {
      scan.ranges[i] = bad;
    }
    look(scan);
    std::string why;
    EXPECT_TRUE(local_occupancy_of(local_.back(), why)) << why;
  }
  for (const std::size_t beams : {1U, 2U, 7U, 100000U}) {
    SCOPED_TRACE(beams);
    look(scan_of(1.0F, beams));
  }
  EXPECT_FALSE(has_nan());
}

TEST_F(Perception, ObstacleAheadIsWhatStandsInFrontOfTheRobotNotOfTheSensor) {
  mount_laser(kPi / 2.0);
  const auto wall_at = [](double bearing_rad) {
    sensor_msgs::LaserScan scan = scan_of(3.0F);
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
      const double bearing = static_cast<double>(scan.angle_min) +
                             static_cast<double>(scan.angle_increment) * static_cast<double>(i);
      if (std::abs(wrap_angle(bearing - bearing_rad)) < kPi / 4.0) {
        scan.ranges[i] = 0.3F;
      }
    }
    return scan;
  };
  // The sensor is turned to the left: what it sees at -90 deg is ahead of the robot.
  // mount_laser() has made sure of a transform, not that no scan of its is still on the way.
  struct Case {
    double bearing_rad;
    bool blocked;
  };
  for (const Case& c :
       {Case{-kPi / 2.0, true}, Case{0.0, false}, Case{kPi / 2.0, false}, Case{-kPi / 2.0, true}}) {
    SCOPED_TRACE(c.bearing_rad);
    sensor_msgs::LaserScan scan = wall_at(c.bearing_rad);
    ASSERT_NO_FATAL_FAILURE(look(scan));
    EXPECT_EQ(ahead_.back().data != 0, c.blocked);
  }
}

TEST_F(Perception, ObserveBringsTheLastObservationOnceMore) {
  observe_.publish(std_msgs::Empty{});  // before there is any: nothing happens
  mount_laser();
  const sensor_msgs::LaserScan scan = scan_of(2.0F);
  look(scan);
  const coarse_map_nav::LocalOccupancy before = local_.back();
  local_.clear();
  observe_.publish(std_msgs::Empty{});
  ASSERT_TRUE(wait_for([this] { return !local_.empty(); }));
  EXPECT_EQ(local_.back().header.stamp, before.header.stamp);
  EXPECT_EQ(local_.back().occupancy, before.occupancy);
}

TEST_F(Perception, TheLocalMapIsOfTheSameLookWiderAndOnlyMadeForWhoListens) {
  mount_laser();
  Inbox<coarse_map_nav::LocalOccupancy> maps{"local_map"};
  ASSERT_TRUE(wait_for([&] { return maps.is_connected(); }));
  const auto is_answered = [&](const sensor_msgs::LaserScan& scan) {
    return !maps.empty() && maps.back().header.stamp == scan.header.stamp;
  };
  // The subscription may reach the node after the first scans.
  sensor_msgs::LaserScan scan;
  ASSERT_TRUE(wait_for([&] {
    scan = scan_of(2.0F);
    scans_.publish(scan);
    return wait_for([&] { return is_answered(scan); }, 0.2);
  })) << node_.output();
  EXPECT_GT(maps.back().resolution * static_cast<float>(maps.back().size),
            local_.back().resolution * static_cast<float>(local_.back().size));
  std::string why;
  EXPECT_TRUE(local_occupancy_of(maps.back(), why)) << why;
  maps.clear();
  observe_.publish(std_msgs::Empty{});
  ASSERT_TRUE(wait_for([&] { return !maps.empty(); })) << "it is repeated on request";
  EXPECT_EQ(maps.back().header.stamp, scan.header.stamp);
}

}  // namespace
}  // namespace cmn
