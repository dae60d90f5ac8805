// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A LiDAR's last scan, for a camera that looks at another moment.
#pragma once

#include "coarse_map_nav/perception/range_projection.hpp"
#include "coarse_map_nav/ros/node_params.hpp"

#include <optional>
#include <string>
#include <utility>

#include <ros/time.h>
#include <tf2_ros/buffer.h>

namespace cmn {

class ScanMemory {
 public:
  ScanMemory(const tf2_ros::Buffer& buffer, FrameParams frames)
      : buffer_{buffer}, frames_{std::move(frames)} {}

  void keep(const RangeScan& scan) { last_ = scan; }
  /// As seen from where the robot was at `stamp`. Empty, and `why` says so, when the scan is much
  /// older or newer or the odometry is unknown.
  std::optional<RangeScan> at(const ros::Time& stamp, std::string& why) const;

 private:
  /// So little older or newer is about the same time.
  static constexpr double kSameTime_s = 0.5;

  const tf2_ros::Buffer& buffer_;
  FrameParams frames_;
  std::optional<RangeScan> last_;
};

}  // namespace cmn
