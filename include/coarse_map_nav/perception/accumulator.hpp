// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What becomes of a look when the next one comes: the seam between pivots and memory.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"

#include <memory>
#include <optional>
#include <string>

namespace cmn {

class Accumulator {
 public:
  virtual ~Accumulator() = default;
  /// Folds in a look and returns all that is known, in the frame and on the cells of the look.
  virtual LocalOccupancy fuse(LocalOccupancy look, const Pose2& T_odom_robot) = 0;
  /// The odometry jumped: what was seen lies nobody knows where.
  virtual void forget() = 0;
  /// False while the last look is only part of what the robot could see from where it stands: it
  /// should turn to the left and look again before anything is concluded.
  virtual bool is_complete() const { return true; }
  /// At the last look.
  virtual std::optional<HeadingDrift> heading_drift() const { return std::nullopt; }
};

struct PerceptionParams;
/// By the word of a parameter: "none", "panorama" (CMN, Robb) or "rolling" (CMP). Throws
/// std::invalid_argument naming any other.
std::unique_ptr<Accumulator> make_accumulator(const std::string& word,
                                              const PerceptionParams& params);

}  // namespace cmn
