// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/simulation/robot_description.hpp"

#include "coarse_map_nav/data/geometry.hpp"

#include <filesystem>
#include <string>

#include "file_fixture.hpp"
#include <gmock/gmock.h>

namespace cmn {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

RobotDescription shipped(const std::string& robot) {
  return read_robot_description(CMN_SOURCE_DIR "/urdf/" + robot + ".urdf");
}
RobotDescription parsed(const std::string& links) {
  return parse_robot_description("<robot name='r'>" + links + "</robot>", "r.urdf");
}
std::string fixed(const std::string& parent, const std::string& child,
                  const std::string& origin = "") {
  return "<joint name='" + parent + "_" + child + "' type='fixed'><parent link='" + parent +
         "'/><child link='" + child + "'/>" + origin + "</joint>";
}
std::string link(const std::string& name) { return "<link name='" + name + "'/>"; }

void expect_pose(const Eigen::Isometry3d& T, double x, double y, double z) {
  EXPECT_NEAR(T.translation().x(), x, 1e-9);
  EXPECT_NEAR(T.translation().y(), y, 1e-9);
  EXPECT_NEAR(T.translation().z(), z, 1e-9);
}
/// REP-103: an optical frame's z looks along the robot's x, its x to the robot's right.
void expect_looks_ahead(const Eigen::Isometry3d& T) {
  EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX(), 1e-9));
  EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitY(), 1e-9));
}

TEST(RobotDescription, EveryShippedOneIsSound) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CMN_SOURCE_DIR "/urdf")) {
    SCOPED_TRACE(entry.path().string());
    const RobotDescription robot = read_robot_description(entry.path().string());
    EXPECT_EQ(robot.root, "base_footprint");
    EXPECT_GT(robot.T_root_link.at("laser").translation().z(), 0.1);
    for (const auto& [name, T_root_link] : robot.T_root_link) {
      EXPECT_LT(T_root_link.translation().norm(), 1.0) << name;
    }
    ++count;
  }
  EXPECT_EQ(count, 3);
}

TEST(RobotDescription, LocobotCarriesItsSensorsWhereInterbotixSays) {
  const SensorMounts mounts = mounts_of(shipped("locobot"), "base_footprint", SensorFrameParams{});
  // Sums of the joints' origins up to the tower and from there, by hand.
  expect_pose(mounts.T_robot_lidar, -0.097997, -0.000044, 0.57693);
  expect_pose(mounts.T_robot_depth, 0.101445, 0.017456, 0.501689);
  expect_pose(mounts.T_robot_color, 0.101445, 0.032456, 0.501689);
  expect_looks_ahead(mounts.T_robot_depth);
  expect_looks_ahead(mounts.T_robot_color);
  const Pose2 lidar = seen_from_above(mounts.T_robot_lidar);
  EXPECT_NEAR(lidar.x, -0.097997, 1e-9);
  EXPECT_NEAR(wrap_angle(lidar.yaw - kPi), 0.0, 1e-9) << "it faces backwards";
}

TEST(RobotDescription, KobukiCarriesItsSensorsWhereTurtlebot2Does) {
  const SensorMounts mounts = mounts_of(shipped("kobuki"), "base_footprint", SensorFrameParams{});
  expect_pose(mounts.T_robot_lidar, 0.1, 0.0, 0.2502);
  expect_pose(mounts.T_robot_depth, -0.087, 0.0135, 0.2972);
  expect_pose(mounts.T_robot_color, -0.087, -0.0135, 0.2972);
  expect_looks_ahead(mounts.T_robot_depth);
}

TEST(RobotDescription, BurgerHasNoCamera) {
  const RobotDescription burger = shipped("turtlebot3");
  const SensorMounts mounts = mounts_of(burger, "base_footprint", {"laser", "", ""});
  expect_pose(mounts.T_robot_lidar, -0.032, 0.0, 0.181);
  EXPECT_TRUE(mounts.T_robot_depth.isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_THAT(error_of([&] { mounts_of(burger, "base_footprint", SensorFrameParams{}); }),
              AllOf(HasSubstr("turtlebot3.urdf"), HasSubstr("no link camera_depth_optical_frame"),
                    HasSubstr("no link camera_color_optical_frame")));
}

TEST(RobotDescription, JointsTurnWhatHangsOnThem) {
  const RobotDescription robot =
      parsed(link("base") + link("mast") + link("laser") +
             fixed("base", "mast", "<origin xyz='1 2 3' rpy='0 0 1.5707963267948966'/>") +
             "<joint name='pan' type='continuous'><parent link='mast'/><child link='laser'/>"
             "<origin xyz='0.5 0 0'/></joint>");
  expect_pose(robot.T_root_link.at("laser"), 1.0, 2.5, 3.0);
}

TEST(RobotDescription, RejectsWhatIsNoUrdf) {
  const auto problem = [](const std::string& xml) {
    return error_of([&] { parse_robot_description(xml, "r.urdf"); });
  };
  for (const std::string xml :
       {"", "no xml at all", "<robot name='r'>", "<robot name='r'><link name='base'/>",
        "<robot><link name='base'/></robot>", "<robot name='r'/>", "<sdf/>",
        "<robot name='r' version='2.0'><link name='base'/></robot>"}) {
    EXPECT_THAT(problem(xml), HasSubstr("r.urdf: ")) << xml;
    EXPECT_THAT(problem(xml), HasSubstr("is no URDF")) << xml;
  }
  EXPECT_THAT(problem("<robot name='r'><link/></robot>"), HasSubstr("No name given"));
  std::string deep = "<robot name='r'>";
  for (int i = 0; i < 200000; ++i) {
    deep += "<a b='/>'>";
  }
  EXPECT_THAT(problem(deep), HasSubstr("more than 100 deep"));
  EXPECT_THAT(error_of([] { read_robot_description("/nowhere/r.urdf"); }),
              HasSubstr("/nowhere/r.urdf: is empty or cannot be read"));
  EXPECT_THAT(error_of([] { read_robot_description(CMN_SOURCE_DIR "/urdf"); }),
              HasSubstr("cannot be read"));
}

TEST(RobotDescription, RejectsLinksThatFormNoTree) {
  const auto problem = [](const std::string& links) { return error_of([&] { parsed(links); }); };
  EXPECT_THAT(problem(link("a") + link("b")), HasSubstr("Two root links"));
  EXPECT_THAT(problem(link("a") + fixed("a", "b")), HasSubstr("child link [b]"));
  EXPECT_THAT(problem(link("b") + fixed("a", "b")), HasSubstr("parent link [a]"));
  EXPECT_THAT(problem(link("a") + link("a")), HasSubstr("not unique"));
  EXPECT_THAT(problem(link("a") + link("b") + fixed("a", "b", "<origin xyz='1 2'/>")),
              HasSubstr("is no URDF"));
  EXPECT_THAT(problem(link("a") + link("b") + fixed("a", "b", "<origin xyz='1 x 2'/>")),
              HasSubstr("is no URDF"));
  EXPECT_THAT(problem(link("a") + link("b") + link("c") + fixed("b", "c") + fixed("c", "b")),
              AllOf(HasSubstr("link b is not joined to the root a"),
                    HasSubstr("link c is not joined to the root a")));
  EXPECT_THAT(problem(link("a") + link("b") + fixed("a", "a")),
              HasSubstr("link a is not joined to the root b"));
  EXPECT_THAT(problem(link("a") + link("b") + link("c") + fixed("a", "b") + fixed("a", "c") +
                      fixed("b", "c")),
              HasSubstr("link c has two parents"));
}

TEST(RobotDescription, NamesEveryMountThatDoesNotFit) {
  const RobotDescription robot =
      parsed(link("base_link") + link("laser") +
             fixed("base_link", "laser", "<origin rpy='3.141592653589793 0 0'/>"));
  const std::string error =
      error_of([&] { mounts_of(robot, "base_footprint", SensorFrameParams{}); });
  EXPECT_THAT(error, AllOf(HasSubstr("r.urdf: its root is base_link"),
                           HasSubstr("no link camera_depth_optical_frame"),
                           HasSubstr("no link camera_color_optical_frame"),
                           HasSubstr("link laser is not level")));
  EXPECT_THAT(error, Not(HasSubstr("no link laser")));
}

}  // namespace
}  // namespace cmn
