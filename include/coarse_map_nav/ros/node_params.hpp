// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What each node has of its own beside the preset, in the order of the data flow.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/localization/update_gate.hpp"
#include "coarse_map_nav/params.hpp"
#include "coarse_map_nav/scene/simulated_robot.hpp"
#include "coarse_map_nav/simulation/robot_description.hpp"

#include <cstdint>
#include <limits>
#include <string>

namespace cmn {

struct FrameParams {
  std::string map = "map";
  std::string odom = "odom";
  std::string base = "base_link";
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("map", self.map, Anything{}, "frame of the drawing (REP-105)");
    visit("odom", self.odom, Anything{}, "frame of the odometry (REP-105)");
    visit("base", self.base, Anything{}, "frame of the robot (REP-105)");
  }
};

struct SimulatorNodeParams {
  std::string world;
  double start_x = std::numeric_limits<double>::quiet_NaN();
  double start_y = std::numeric_limits<double>::quiet_NaN();
  double start_yaw_deg = std::numeric_limits<double>::quiet_NaN();
  std::uint32_t seed = 1;
  double speed = 1.0;
  double odometry_rate = 50.0;
  double scan_rate = 10.0;
  double camera_rate = 5.0;
  double command_timeout_s = 0.6;
  SensorFrameParams sensor_frames;
  SimulatedRobotParams simulation;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("world", self.world, Anything{},
          "what it drives in: a map (map_server yaml), a Gazebo world (.world, .sdf), house:SEED");
    visit("start_x", self.start_x, Between{-1e6, 1e6}, "[m] start; nan: drawn from the seed");
    visit("start_y", self.start_y, Between{-1e6, 1e6}, "[m] start; nan: drawn from the seed");
    visit("start_yaw_deg", self.start_yaw_deg, Between{-360.0, 360.0},
          "[deg] start; nan: one of the four headings, drawn from the seed");
    visit("seed", self.seed, Between{0, 4294967295.0}, "seed of the start, noise and slip");
    visit("speed", self.speed, Between{0.1, 100.0}, "[-] simulated over real time");
    visit("odometry_rate", self.odometry_rate, Between{5.0, 500.0}, "[Hz] odom, TF and /clock");
    visit("scan_rate", self.scan_rate, Between{0.5, 100.0}, "[Hz] scan");
    visit("camera_rate", self.camera_rate, Between{0.5, 100.0},
          "[Hz] depth/image, points, image and their camera_info, while somebody listens");
    visit("command_timeout_s", self.command_timeout_s, Between{0.05, 10.0},
          "[s] the base stops when cmd_vel is silent for so long (Kobuki: 0.6)");
    SensorFrameParams::visit_params(self.sensor_frames, visit);
    visit.group("simulation", self.simulation);
  }
};

struct MapServerParams {
  std::string map;
  double resolution = 0.4;
  bool close_pockets = true;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("map", self.map, Anything{}, "file of the drawing: .yaml (map_server), .npy, image");
    visit("resolution", self.resolution, Between{0.01, 10.0},
          "[m/cell] nominal, for files that do not say");
    visit("close_pockets", self.close_pockets, Anything{},
          "take free cells that are not joined to the largest free region as occupied");
  }
};

struct PerceptionNodeParams {
  double scan_timeout_s = 1.0;
  double depth_timeout_s = 1.0;
  double image_timeout_s = 1.0;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("scan_timeout_s", self.scan_timeout_s, Between{0.05, 60.0},
          "[s] scans silent for longer are an error in /diagnostics");
    visit("depth_timeout_s", self.depth_timeout_s, Between{0.05, 60.0},
          "[s] a depth camera silent for longer is an error in /diagnostics");
    visit("image_timeout_s", self.image_timeout_s, Between{0.05, 60.0},
          "[s] a colour camera silent for longer is an error in /diagnostics");
  }
};

struct LocalizerNodeParams {
  UpdateGateParams gate;
  double transform_tolerance_s = 0.5;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    UpdateGateParams::visit_params(self.gate, visit);
    visit("transform_tolerance_s", self.transform_tolerance_s, Between{0.0, 10.0},
          "[s] map -> odom is stamped so far ahead of the observation (as amcl's)");
  }
};

struct PlannerNodeParams {
  double resend_after_s = 5.0;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("resend_after_s", self.resend_after_s, Between{0.5, 120.0},
          "[s] without an answer for so long, the last action is sent again");
  }
};

struct MotionNodeParams {
  double obstacle_timeout_s = 0.5;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("obstacle_timeout_s", self.obstacle_timeout_s, Between{0.05, 10.0},
          "[s] with clear_ahead silent for longer the robot does not move forward");
  }
};

}  // namespace cmn
