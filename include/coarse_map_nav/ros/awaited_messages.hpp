// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Messages of a sensor that are held back until TF knows where it was.
#pragma once

#include "coarse_map_nav/ros/node.hpp"
#include "coarse_map_nav/ros/node_params.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <message_filters/subscriber.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>

namespace cmn {

/// Hears a topic and hands a message on once the transforms of its time are there; a message whose
/// transforms do not come is counted as dropped.
template <class Message>
class AwaitedMessages {
 public:
  template <class Handle>  // takes a const Message&
  AwaitedMessages(ros::NodeHandle& nh, const std::string& topic, tf2_ros::Buffer& buffer,
                  const FrameParams& frames, InputMonitor& monitor, Handle handle)
      : filter_{subscriber_, buffer, frames.odom, kQueue, nh} {
    filter_.setTargetFrames(std::vector<std::string>{frames.base, frames.odom});
    filter_.registerCallback([handle](const typename Message::ConstPtr& msg) { handle(*msg); });
    filter_.registerFailureCallback(
        [&monitor, frames](const typename Message::ConstPtr& msg, auto /*reason*/) {
          monitor.dropped("no transform from " + msg->header.frame_id + " to " + frames.base +
                          " and " + frames.odom + " at its time");
        });
    subscriber_.subscribe(nh, topic, kQueue);
  }

 private:
  static constexpr std::uint32_t kQueue = 3;

  message_filters::Subscriber<Message> subscriber_;
  tf2_ros::MessageFilter<Message> filter_;
};

}  // namespace cmn
