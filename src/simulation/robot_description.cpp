// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/simulation/robot_description.hpp"

#include "coarse_map_nav/data/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

namespace cmn {
namespace {

/// TinyXML, behind urdfdom, descends into elements as deep as the stack allows, and deeper.
constexpr int kDeepest = 100;

/// A sentence that grows.
class Problems {
 public:
  void add(const std::string& problem) { text_ += (text_.empty() ? "" : "; ") + problem; }
  void throw_if_any(const std::string& name) const {
    if (!text_.empty()) {
      throw std::runtime_error(name + ": " + text_);
    }
  }

 private:
  std::string text_;
};

/// While it lives, what urdfdom has to complain about goes here instead of to standard error.
class Complaints : public console_bridge::OutputHandler {
 public:
  Complaints() : before_{console_bridge::getOutputHandler()} {
    console_bridge::useOutputHandler(this);
  }
  ~Complaints() override { console_bridge::useOutputHandler(before_); }
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/,
           int /*line*/) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) {
      errors.push_back(text);
    }
  }

  std::vector<std::string> errors;

 private:
  console_bridge::OutputHandler* before_;
};

/// How deep elements lie in one another.
int nesting_of(const std::string& xml) {
  int depth = 0;
  int deepest = 0;
  for (std::size_t i = xml.find('<'); i != std::string::npos; i = xml.find('<', i + 1)) {
    if (xml.compare(i, 4, "<!--") == 0) {
      i = std::min(xml.find("-->", i), xml.size());
    } else if (xml.compare(i, 2, "</") == 0) {
      --depth;
    } else if (xml.compare(i, 2, "<!") != 0 && xml.compare(i, 2, "<?") != 0) {
      char quote = 0;
      while (++i < xml.size() && (quote != 0 || xml[i] != '>')) {
        const bool is_quote = xml[i] == '"' || xml[i] == '\'';
        quote = quote == 0 && is_quote ? xml[i] : quote == xml[i] ? 0 : quote;
      }
      depth += xml[i - 1] == '/' ? 0 : 1;
      deepest = std::max(deepest, depth);
    }
  }
  return deepest;
}

Eigen::Isometry3d pose_of(const urdf::Pose& pose) {
  Eigen::Isometry3d T_parent_child = Eigen::Isometry3d::Identity();
  T_parent_child.translation() = Eigen::Vector3d{pose.position.x, pose.position.y, pose.position.z};
  const urdf::Rotation& q = pose.rotation;
  T_parent_child.linear() = Eigen::Quaterniond{q.w, q.x, q.y, q.z}.toRotationMatrix();
  return T_parent_child;
}

/// Places the links from the root outwards. urdfdom itself accepts links in a ring of their own and
/// with two parents.
void place_links(const urdf::ModelInterface& model, RobotDescription& robot, Problems& problems) {
  robot.root = model.getRoot()->name;
  robot.T_root_link[robot.root] = Eigen::Isometry3d::Identity();
  std::vector<urdf::LinkConstSharedPtr> open{model.getRoot()};
  while (!open.empty()) {
    const urdf::LinkConstSharedPtr parent = open.back();
    open.pop_back();
    for (const urdf::JointSharedPtr& joint : parent->child_joints) {
      const std::string& child = joint->child_link_name;
      const Eigen::Isometry3d T_root_child =
          robot.T_root_link[parent->name] * pose_of(joint->parent_to_joint_origin_transform);
      if (!T_root_child.matrix().allFinite()) {
        problems.add("joint " + joint->name + " has an origin that is not finite");
      } else if (!robot.T_root_link.emplace(child, T_root_child).second) {
        problems.add("link " + child + " has two parents");
      } else {
        open.push_back(model.getLink(child));
      }
    }
  }
  for (const auto& [name, link] : model.links_) {
    if (robot.T_root_link.count(name) == 0) {
      problems.add("link " + name + " is not joined to the root " + robot.root);
    }
  }
}

}  // namespace

RobotDescription parse_robot_description(const std::string& xml, const std::string& name) {
  RobotDescription robot;
  robot.name = name;
  Problems problems;
  if (nesting_of(xml) > kDeepest) {
    problems.add("is no URDF: its elements lie more than " + std::to_string(kDeepest) + " deep");
  }
  problems.throw_if_any(name);
  Complaints complaints;
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(xml);
  for (const std::string& error : complaints.errors) {
    problems.add(error);
  }
  if (!model) {
    problems.add("is no URDF");
  } else {
    for (const auto& [link_name, link] : model->links_) {
      link->child_links.clear();  // links in a ring would own each other for ever
    }
  }
  problems.throw_if_any(name);
  place_links(*model, robot, problems);
  problems.throw_if_any(name);
  return robot;
}

RobotDescription read_robot_description(const std::string& path) {
  std::ifstream file{path, std::ios::binary};
  std::ostringstream xml;
  xml << file.rdbuf();
  if (!file || !xml) {
    throw std::runtime_error(path + ": is empty or cannot be read; is the path right?");
  }
  return parse_robot_description(xml.str(), path);
}

SensorMounts mounts_of(const RobotDescription& robot, const std::string& base,
                       const SensorFrameParams& frames) {
  Problems problems;
  if (robot.root != base) {
    problems.add("its root is " + robot.root + ", not the robot's frame " + base);
  }
  const auto mount = [&](const std::string& link) {
    const auto found = robot.T_root_link.find(link);
    if (found == robot.T_root_link.end()) {
      if (!link.empty()) {
        problems.add("has no link " + link);
      }
      return Eigen::Isometry3d{Eigen::Isometry3d::Identity()};
    }
    return found->second;
  };
  const SensorMounts mounts{mount(frames.laser), mount(frames.depth), mount(frames.color)};
  if (mounts.T_robot_lidar.linear()(2, 2) < std::cos(2.0 * kPi / 180.0)) {
    problems.add("link " + frames.laser +
                 " is not level: a planar LiDAR is taken to lie flat, upright");
  }
  problems.throw_if_any(robot.name);
  return mounts;
}

}  // namespace cmn
