// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A robot's description (URDF) -> where its links are.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/simulation/sensor_mounts.hpp"

#include <map>
#include <string>

#include <Eigen/Geometry>

namespace cmn {

/// The links of a robot, every joint at zero.
struct RobotDescription {
  std::string name;  ///< what errors call it: the file, or where the text came from
  std::string root;  ///< the link that has no parent
  std::map<std::string, Eigen::Isometry3d> T_root_link;  ///< of every link, by its name
};

/// Reads the text of a URDF. Throws std::runtime_error with one sentence that says all that is
/// wrong with it: no XML, a joint without its links, a link that is not joined to the root, ...
RobotDescription parse_robot_description(const std::string& xml, const std::string& name);

/// The same of a file; one that cannot be read is such an error too.
RobotDescription read_robot_description(const std::string& path);

/// Which links carry the sensors. An empty name: the robot has no such sensor.
struct SensorFrameParams {
  std::string laser = "laser";
  std::string depth = "camera_depth_optical_frame";
  std::string color = "camera_color_optical_frame";
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("laser_frame", self.laser, Anything{}, "link of the LiDAR in the robot's description");
    visit("depth_frame", self.depth, Anything{},
          "link of the depth camera, its optical frame; empty: the robot has none");
    visit("color_frame", self.color, Anything{},
          "link of the colour camera, its optical frame; empty: the robot has none");
  }
};

/// The mounts of the sensors in the description's root, which has to be called `base`. A sensor
/// that the robot has not stays at the root. Throws std::runtime_error that names everything that
/// does not fit: another root, links that are missing, a LiDAR that is not level (2 degrees).
SensorMounts mounts_of(const RobotDescription& robot, const std::string& base,
                       const SensorFrameParams& frames);

}  // namespace cmn
