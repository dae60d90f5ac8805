// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/color_input.hpp"

#include "coarse_map_nav/ros/camera_conversions.hpp"
#include "coarse_map_nav/ros/tf_lookup.hpp"

#include <string>
#include <utility>

namespace cmn {

ColorInput::ColorInput(ros::NodeHandle& nh, tf2_ros::Buffer& buffer, const FrameParams& frames,
                       double timeout_s, OnImage on_image)
    : buffer_{buffer},
      frames_{frames},
      on_image_{std::move(on_image)},
      monitor_{"image", timeout_s},
      info_sub_{nh.subscribe<sensor_msgs::CameraInfo>("image/camera_info", 1,
                                                      [this](const auto& msg) { info_ = *msg; })},
      images_{nh, "image", buffer, frames, monitor_, [this](const auto& msg) { on_message(msg); }} {}

void ColorInput::on_message(const sensor_msgs::Image& msg) {
  if (!info_) {
    monitor_.dropped("the image has no image/camera_info yet");
    return;
  }
  std::string why;
  const auto mount =
      lookup_mount(buffer_, frames_.base, msg.header.frame_id, msg.header.stamp, why);
  const auto camera = mount ? camera_of(*info_, why) : std::nullopt;
  const auto image = camera ? color_of(msg, *camera, *mount, why) : std::nullopt;
  if (!image) {
    monitor_.dropped(why);
    return;
  }
  monitor_.received(msg.header.stamp);
  on_image_(*image, msg.header);
}

}  // namespace cmn
