// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// sensors -> local occupancy, and whether the way ahead is blocked.

#include "coarse_map_nav/learning/torch_predictor.hpp"
#include "coarse_map_nav/motion/rest_detector.hpp"
#include "coarse_map_nav/perception/perception.hpp"
#include "coarse_map_nav/ros/color_input.hpp"
#include "coarse_map_nav/ros/contact_input.hpp"
#include "coarse_map_nav/ros/depth_input.hpp"
#include "coarse_map_nav/ros/node.hpp"
#include "coarse_map_nav/ros/node_params.hpp"
#include "coarse_map_nav/ros/panorama_strip.hpp"
#include "coarse_map_nav/ros/percept_publisher.hpp"
#include "coarse_map_nav/ros/scan_input.hpp"
#include "coarse_map_nav/ros/scan_memory.hpp"
#include "coarse_map_nav/ros/tf_lookup.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <ros/ros.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

namespace {

/// Null where the source needs none. A file that is no network ends the process.
std::shared_ptr<cmn::OccupancyPredictor> predictor_or_exit(const cmn::PerceptionParams& params) {
  if (!params.uses_color()) {
    return nullptr;
  }
  try {
    return cmn::load_predictor(params.rgb.model);
  } catch (const std::runtime_error& e) {
    cmn::exit_with({std::string{"perception/rgb/model: "} + e.what()});
  }
}

class PerceptionNode {
 public:
  PerceptionNode()
      : params_{cmn::load_params_or_exit<cmn::NodeParams<cmn::PerceptionNodeParams>>(
            ros::NodeHandle("~"))},
        perception_{perception_params(), predictor_or_exit(perception_params())},
        publisher_{nh_, params_.navigator.planning.step_m} {
    diagnostics_.setHardwareID("none");
    if (perception_params().uses_scan()) {
      scans_.emplace(nh_, tf_buffer_, params_.frames, params_.own.scan_timeout_s, needs_odometry_,
                     [this](const auto& scan, const auto& header) { on_scan(scan, header); });
      diagnostics_.add("scan", &scans_->monitor(), &cmn::InputMonitor::report);
    }
    if (perception_params().uses_depth()) {
      depth_.emplace(nh_, tf_buffer_, params_.frames, params_.own.depth_timeout_s,
                     [this](const auto& data, const auto& header) { on_depth(data, header); });
      diagnostics_.add("depth", &depth_->monitor(), &cmn::InputMonitor::report);
      diagnostics_.add("floor", this, &PerceptionNode::report_floor);
    }
    if (perception_params().uses_color()) {
      color_.emplace(nh_, tf_buffer_, params_.frames, params_.own.image_timeout_s,
                     [this](const auto& image, const auto& header) { on_color(image, header); });
      diagnostics_.add("image", &color_->monitor(), &cmn::InputMonitor::report);
    }
    if (is_panorama_) {
      strip_.emplace(nh_);
    }
    timer_ = nh_.createTimer(ros::Duration(1.0),
                             [this](const ros::TimerEvent&) { diagnostics_.update(); });
  }

 private:
  const cmn::PerceptionParams& perception_params() const { return params_.navigator.perception; }

  void on_scan(const cmn::RangeScan& scan, const std_msgs::Header& header) {
    cmn::SensorData data;
    data.scan = &scan;
    if (!depth_ && !color_) {
      look(data, header, scans_->monitor());
    } else {  // it guards, and waits for the camera
      publisher_.publish_guard(perception_.clear_ahead_m(data));
      last_scan_.keep(scan);
    }
  }

  void on_depth(const cmn::SensorData& depth, const std_msgs::Header& header) {
    look_with_scan(depth, header, depth_->monitor());
  }

  void on_color(const cmn::ColorImage& image, const std_msgs::Header& header) {
    cmn::SensorData data;
    data.color = &image;
    look_with_scan(data, header, color_->monitor());
  }

  /// A look of a camera, with the LiDAR beside it.
  void look_with_scan(cmn::SensorData data, const std_msgs::Header& header,
                      cmn::InputMonitor& camera) {
    std::optional<cmn::RangeScan> scan;
    if (scans_) {
      std::string why;
      if (!(scan = last_scan_.at(header.stamp, why))) {
        camera.dropped(why);
        return;
      }
      data.scan = &*scan;
    }
    look(data, header, camera);
  }

  void look(const cmn::SensorData& data, std_msgs::Header header, cmn::InputMonitor& input) {
    header.frame_id = params_.frames.base;
    cmn::Pose2 T_odom_robot;
    if (needs_odometry_) {
      std::string why;
      const auto pose =
          cmn::lookup(tf_buffer_, params_.frames.odom, params_.frames.base, header.stamp, why);
      if (!pose) {
        input.dropped(why);
        return;
      }
      T_odom_robot = *pose;
    }
    if (header.stamp < last_stamp_) {  // of another odometry
      perception_.forget();
      contacts_.forget();
      rest_.reset();
    }
    last_stamp_ = header.stamp;
    rest_.update({header.stamp.toSec(), T_odom_robot});
    if (is_panorama_ && !rest_.at_rest()) {
      publisher_.publish_guard(perception_.clear_ahead_m(data));
      return;
    }
    // Both views of a panorama are made of the same looks.
    cmn::Percept percept =
        perception_.look(data, T_odom_robot, is_panorama_ || publisher_.has_map_listener());
    if (percept.beams.used == 0 && !depth_ && !color_) {
      input.dropped("no range of the scan is usable");
      return;
    }
    contacts_.mark(percept.local_map);
    publisher_.publish_guard(percept.clear_ahead_m);
    publisher_.publish(percept, header);
    if (strip_) {
      strip_->look(data.image != nullptr ? data.image->depth_m : cv::Mat{}, T_odom_robot.yaw,
                   percept.is_complete, header);
    }
  }

  void report_floor(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using Status = diagnostic_msgs::DiagnosticStatus;
    const cmn::DepthReport& report = perception_.depth_report();
    status.summary(Status::OK, report.floor == cmn::FloorSource::kSeen ? "seen"
                               : report.floor == cmn::FloorSource::kLast
                                   ? "not in view, as last seen"
                                   : "as the mount says");
    status.add("slope [deg]",
               std::atan(static_cast<double>(report.plane.slope.norm())) * 180.0 / cmn::kPi);
    status.add("offset [m]", report.plane.offset_m);
    status.add("points", report.points);
    status.add("without a reading", report.unusable);
    status.add("flying", report.flying);
    status.add("isolated", report.isolated);
  }

  ros::NodeHandle nh_;
  cmn::NodeParams<cmn::PerceptionNodeParams> params_;
  const bool is_panorama_ = perception_params().accumulate == "panorama";
  const bool needs_odometry_ = perception_params().accumulate != "none" ||
                               perception_params().source == "fused" ||
                               perception_params().uses_color();
  cmn::Perception perception_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_{tf_buffer_};
  cmn::PerceptPublisher publisher_;
  cmn::ContactInput contacts_{nh_, tf_buffer_, params_.frames, perception_params().guard.radius_m};
  cmn::RestDetector rest_;
  ros::Time last_stamp_;
  cmn::ScanMemory last_scan_{tf_buffer_, params_.frames};  ///< of a LiDAR beside a camera
  std::optional<cmn::ScanInput> scans_;
  std::optional<cmn::DepthInput> depth_;
  std::optional<cmn::ColorInput> color_;
  std::optional<cmn::PanoramaStrip> strip_;
  diagnostic_updater::Updater diagnostics_;
  ros::Timer timer_;
};

}  // namespace

int main(int argc, char** argv) { return cmn::spin_node<PerceptionNode>(argc, argv, "perception"); }
