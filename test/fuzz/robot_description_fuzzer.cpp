// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Any text -> a robot's description.
#include "coarse_map_nav/simulation/robot_description.hpp"

#include <stdexcept>

#include "fuzz_input.hpp"

namespace cmn {

std::vector<std::string> fuzz_seeds() {
  return {
      "<robot name='r'><link name='base_footprint'/><link name='laser'/>"
      "<joint name='j' type='fixed'><parent link='base_footprint'/><child link='laser'/>"
      "<origin xyz='-0.1 0 0.58' rpy='0 0 3.14'/></joint></robot>",
      "<robot name='r' version='1.0'><material name='m'><color rgba='0 0 0 1'/></material>"
      "<link name='a'><visual><origin xyz='0 0 1'/><geometry><box size='1 2 3'/></geometry>"
      "<material name='m'/></visual><collision><geometry><cylinder radius='1' length='2'/>"
      "</geometry></collision><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' "
      "iyy='1' iyz='0' izz='1'/></inertial></link><link name='b'/><joint name='j' "
      "type='revolute'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/><limit "
      "effort='1' velocity='1' lower='-1' upper='1'/></joint></robot>"};
}

}  // namespace cmn

/// urdfdom never frees links in a ring of a description that it rejects for having no root.
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string xml{reinterpret_cast<const char*>(data), size};
  try {
    const cmn::RobotDescription robot = cmn::parse_robot_description(xml, "r.urdf");
    cmn::require(robot.T_root_link.count(robot.root) == 1, "the root is a link");
    for (const auto& [link, T_root_link] : robot.T_root_link) {
      cmn::require(T_root_link.matrix().allFinite(), "poses are finite");
    }
    mounts_of(robot, "base_footprint", cmn::SensorFrameParams{});
  } catch (const std::runtime_error& e) {
    cmn::require(std::string{e.what()}.find("r.urdf: ") == 0, "errors say where");
  }
  return 0;
}
