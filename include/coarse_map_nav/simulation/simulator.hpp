// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A planar world, a Kobuki-like base in it and a LiDAR on the base.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/odometry.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"
#include "coarse_map_nav/simulation/range_sensor.hpp"
#include "coarse_map_nav/simulation/robot_model.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <cstdint>

namespace cmn {

struct SimulationParams {
  RobotParams robot;
  LidarParams lidar;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit.group("robot", self.robot);
    visit.group("lidar", self.lidar);
  }
};

/// The whole simulation. Deterministic: the same calls from the same seed give the same numbers.
///
/// Time passes only in advance(). Base and LiDAR draw from generators of their own, so that
/// looking does not change the way the robot drives. The odometry frame is the pose in which the
/// robot woke up: its first sample is the identity, whatever the start.
class Simulator {
 public:
  /// Throws std::invalid_argument when the robot would start inside an obstacle.
  Simulator(World world, const SimulationParams& params, const Pose2& T_world_start,
            std::uint32_t seed, const Pose2& T_robot_lidar = {});

  /// Lets `dt_s` > 0 pass under one command, in equal steps of at most 5 ms.
  void advance(double dt_s, const VelocityCommand& command);
  double time_s() const { return time_s_; }

  Pose2 truth() const { return robot_.state().T_world_robot; }
  OdometrySample odometry() const { return {time_s_, robot_.state().T_odom_robot}; }
  /// Forward and turning speed as the wheels have it.
  VelocityCommand velocity() const { return robot_.state().velocity; }
  /// What the LiDAR sees now; each call draws new noise.
  RangeScan scan() { return sensor_.measure(world_, truth(), time_s_); }
  /// The bumper: comes on in a collision and stays on until the robot moves or turns away (20 deg).
  bool bumped() const { return robot_.state().bumped; }

  /// Kidnaps the robot; odometry does not notice. Throws as the constructor does.
  void set_truth(const Pose2& T_world_robot);

  const World& world() const { return world_; }
  double driven_m() const { return robot_.state().driven_m; }
  int collisions() const { return robot_.state().collisions; }

 private:
  void require_free(const Pose2& T_world_robot) const;

  World world_;
  SimulationParams params_;
  RobotModel robot_;
  RangeSensor sensor_;
  double time_s_ = 0.0;
};

}  // namespace cmn
