// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether the base touches something, of whichever message its driver tells it in.
#pragma once

#include <cstdint>

#include <ros/ros.h>
#include <topic_tools/shape_shifter.h>

namespace cmn {

/// Listens to `bumper`: std_msgs/Bool (pressed), or kobuki_msgs/BumperEvent, one of which says that
/// one of a Kobuki's three bumpers was pressed or let go.
///
/// The latter is read byte by byte, so that kobuki_msgs, which Debian lacks, is not needed. Another
/// type is warned about and ignored.
class Bumper {
 public:
  explicit Bumper(ros::NodeHandle& nh);
  bool is_pressed() const { return pressed_ != 0; }

 private:
  void on_message(const topic_tools::ShapeShifter& message);

  std::uint32_t pressed_ = 0;  ///< a bit for each bumper
  ros::Subscriber subscriber_;
};

}  // namespace cmn
