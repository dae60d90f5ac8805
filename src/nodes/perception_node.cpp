// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// sensors -> local occupancy, and whether the way ahead is blocked.

#include "coarse_map_nav/perception/obstacle_guard.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"
#include "coarse_map_nav/perception/rolling_map.hpp"
#include "coarse_map_nav/ros/conversions.hpp"
#include "coarse_map_nav/ros/node.hpp"
#include "coarse_map_nav/ros/node_params.hpp"
#include "coarse_map_nav/ros/tf_lookup.hpp"

#include <optional>
#include <string>

#include <message_filters/subscriber.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Float32.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>
#include <tf2_ros/transform_listener.h>

namespace {

class PerceptionNode {
 public:
  PerceptionNode()
      : params_{cmn::load_params_or_exit<cmn::NodeParams<cmn::PerceptionNodeParams>>(
            ros::NodeHandle("~"))},
        projector_{params_.navigator.perception.local_occupancy},
        map_projector_{params_.navigator.perception.local_map},
        rolling_{params_.navigator.perception.rolling},
        rolling_map_{params_.navigator.perception.rolling},
        scans_{"scan", params_.own.scan_timeout_s} {
    local_pub_ = nh_.advertise<coarse_map_nav::LocalOccupancy>("local_occupancy", 1);
    map_pub_ = nh_.advertise<coarse_map_nav::LocalOccupancy>("local_map", 1);
    grid_pub_ = nh_.advertise<nav_msgs::OccupancyGrid>("local_occupancy/grid", 1);
    blocked_pub_ = nh_.advertise<std_msgs::Bool>("obstacle_ahead", 1);
    clear_pub_ = nh_.advertise<std_msgs::Float32>("clear_ahead", 1);
    if (is_rolling_) {  // waits for the odometry of its time
      scan_filter_.emplace(rolling_scan_sub_, tf_buffer_, params_.frames.odom, 5, nh_);
      scan_filter_->registerCallback(
          [this](const sensor_msgs::LaserScan::ConstPtr& scan) { on_scan(*scan); });
      scan_filter_->registerFailureCallback([this](const sensor_msgs::LaserScan::ConstPtr&, auto) {
        scans_.dropped("no transform to " + params_.frames.odom + " at its time");
      });
      rolling_scan_sub_.subscribe(nh_, "scan", 5);
    } else {
      scan_sub_ = nh_.subscribe("scan", 1, &PerceptionNode::on_scan, this);
    }
    observe_sub_ = nh_.subscribe("observe", 1, &PerceptionNode::on_observe, this);
    diagnostics_.setHardwareID("none");
    diagnostics_.add("scan", &scans_, &cmn::InputMonitor::report);
    timer_ = nh_.createTimer(ros::Duration(1.0),
                             [this](const ros::TimerEvent&) { diagnostics_.update(); });
  }

 private:
  void on_scan(const sensor_msgs::LaserScan& scan) {
    const std::string fault = cmn::fault_of(scan);
    if (!fault.empty()) {
      scans_.dropped(fault);
      return;
    }
    std::string why;
    const std::optional<cmn::Pose2> T_robot_sensor =
        cmn::lookup(tf_buffer_, params_.frames.base, scan.header.frame_id, scan.header.stamp, why);
    if (!T_robot_sensor) {
      scans_.dropped(why);
      return;
    }
    scans_.received(scan.header.stamp);
    cmn::BeamCount beams;
    const cmn::RangeScan ranges = cmn::scan_of(scan, *T_robot_sensor);
    cmn::LocalOccupancy local = projector_.project(ranges, &beams);
    if (beams.used == 0) {
      scans_.dropped("no range of the scan is usable");
      return;
    }
    std_msgs::Float32 clear;
    clear.data =
        static_cast<float>(cmn::clear_ahead_m(ranges, local, params_.navigator.perception.guard));
    clear_pub_.publish(clear);
    std_msgs::Bool blocked;
    blocked.data = static_cast<std::uint8_t>(clear.data < params_.navigator.planning.step_m);
    blocked_pub_.publish(blocked);

    std_msgs::Header header = scan.header;
    header.frame_id = params_.frames.base;
    if (is_rolling_ && !accumulate(ranges, local, header)) {
      return;
    }
    last_ = cmn::message_of(local, header);
    last_->clear_ahead = clear.data;
    local_pub_.publish(*last_);
    last_ranges_ = ranges;
    publish_local_map();
    if (grid_pub_.getNumSubscribers() > 0) {
      grid_pub_.publish(cmn::grid_message(local, header));
    }
  }

  /// Adds to a look what was seen before, and folds it in.
  bool accumulate(const cmn::RangeScan& ranges, cmn::LocalOccupancy& local,
                  const std_msgs::Header& header) {
    std::string why;
    const std::optional<cmn::Pose2> T_odom_robot =
        cmn::lookup(tf_buffer_, params_.frames.odom, params_.frames.base, header.stamp, why);
    if (!T_odom_robot) {
      scans_.dropped(why);
      return false;
    }
    if (last_ && header.stamp < last_->header.stamp) {  // of another odometry
      rolling_.forget();
      rolling_map_.forget();
    }
    local = rolling_.fuse(local, *T_odom_robot);
    if (map_pub_.getNumSubscribers() > 0) {
      last_map_ = rolling_map_.fuse(map_projector_.project(ranges), *T_odom_robot);
    }
    return true;
  }

  /// Somebody missed the last observation: once more.
  void on_observe(const std_msgs::Empty& /*request*/) {
    if (last_) {
      local_pub_.publish(*last_);
      publish_local_map();
    }
  }

  /// Of the last scan.
  void publish_local_map() {
    if (map_pub_.getNumSubscribers() > 0) {
      if (!is_rolling_) {
        last_map_ = map_projector_.project(last_ranges_);
      } else if (last_map_.stamp_s != last_ranges_.stamp_s) {
        return;  // it was not yet listened to
      }
      coarse_map_nav::LocalOccupancy map = cmn::message_of(last_map_, last_->header);
      map.clear_ahead = last_->clear_ahead;
      map_pub_.publish(map);
    }
  }

  ros::NodeHandle nh_;
  cmn::NodeParams<cmn::PerceptionNodeParams> params_;
  cmn::RangeProjector projector_;
  cmn::RangeProjector map_projector_;
  const bool is_rolling_ = params_.navigator.perception.accumulate == "rolling";
  cmn::RollingMap rolling_;
  cmn::RollingMap rolling_map_;
  cmn::InputMonitor scans_;
  std::optional<coarse_map_nav::LocalOccupancy> last_;
  cmn::RangeScan last_ranges_;  ///< of which it was made
  cmn::LocalOccupancy last_map_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_{tf_buffer_};
  ros::Publisher local_pub_;
  ros::Publisher grid_pub_;
  ros::Publisher map_pub_;
  ros::Publisher blocked_pub_;
  ros::Publisher clear_pub_;
  ros::Subscriber scan_sub_;
  message_filters::Subscriber<sensor_msgs::LaserScan> rolling_scan_sub_;
  std::optional<tf2_ros::MessageFilter<sensor_msgs::LaserScan>> scan_filter_;
  ros::Subscriber observe_sub_;
  diagnostic_updater::Updater diagnostics_;
  ros::Timer timer_;
};

}  // namespace

int main(int argc, char** argv) { return cmn::spin_node<PerceptionNode>(argc, argv, "perception"); }
