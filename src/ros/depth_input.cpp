// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/depth_input.hpp"

#include "coarse_map_nav/ros/camera_conversions.hpp"
#include "coarse_map_nav/ros/tf_lookup.hpp"

#include <string>
#include <utility>

namespace cmn {

DepthInput::DepthInput(ros::NodeHandle& nh, tf2_ros::Buffer& buffer, const FrameParams& frames,
                       double timeout_s, OnData on_data)
    : buffer_{buffer},
      frames_{frames},
      on_data_{std::move(on_data)},
      monitor_{"depth", timeout_s},
      info_sub_{nh.subscribe<sensor_msgs::CameraInfo>("camera_info", 1,
                                                      [this](const auto& msg) { info_ = *msg; })},
      clouds_{nh, "points", buffer, frames, monitor_, [this](const auto& msg) { on_cloud(msg); }},
      images_{nh,     "depth/image", buffer,
              frames, monitor_,      [this](const auto& msg) { on_image(msg); }} {}

std::optional<Eigen::Isometry3d> DepthInput::mount_of(const std_msgs::Header& header) {
  std::string why;
  const auto mount = lookup_mount(buffer_, frames_.base, header.frame_id, header.stamp, why);
  if (!mount) {
    monitor_.dropped(why);
  }
  return mount;
}

void DepthInput::on_cloud(const sensor_msgs::PointCloud2& msg) {
  const std::optional<Eigen::Isometry3d> mount = mount_of(msg.header);
  if (!mount) {
    return;
  }
  std::string why;
  const std::optional<PointCloudView> cloud = view_of(msg, *mount, why);
  if (!cloud) {
    monitor_.dropped(why);
    return;
  }
  monitor_.received(msg.header.stamp);
  SensorData data;
  data.cloud = &*cloud;
  on_data_(data, msg.header);
}

void DepthInput::on_image(const sensor_msgs::Image& msg) {
  if (!info_) {
    monitor_.dropped("the depth image has no camera_info yet");
    return;
  }
  const std::optional<Eigen::Isometry3d> mount = mount_of(msg.header);
  if (!mount) {
    return;
  }
  std::string why;
  const std::optional<CameraModel> camera = camera_of(*info_, why);
  const std::optional<DepthImage> image =
      camera ? depth_of(msg, *camera, *mount, why) : std::nullopt;
  if (!image) {
    monitor_.dropped(why);
    return;
  }
  monitor_.received(msg.header.stamp);
  SensorData data;
  data.image = &*image;
  on_data_(data, msg.header);
}

}  // namespace cmn
