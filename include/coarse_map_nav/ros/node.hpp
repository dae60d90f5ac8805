// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What every node of the package does alike: parameters, exits, diagnostics.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/params.hpp"
#include "coarse_map_nav/ros/node_params.hpp"

#include <map>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

namespace cmn {

/// A node's private parameters: the preset (all groups of it, so that one file serves every node),
/// the frames and what is the node's own.
template <class Own>
struct NodeParams {
  NavigatorParams navigator;
  FrameParams frames;
  Own own;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    NavigatorParams::visit_params(self.navigator, visit);
    visit.group("frames", self.frames);
    Own::visit_params(self.own, visit);
  }
};

/// Everything below a namespace of the parameter server, flat. A list or binary value is kept as an
/// empty word under its name, which no parameter accepts.
ParamTree read_param_server(const ros::NodeHandle& nh);

/// Logs every problem as an error and ends the process with status 1.
[[noreturn]] void exit_with(const std::vector<std::string>& problems);

/// The node's private parameters, or exit 1 with every problem listed.
template <class Params>
Params load_params_or_exit(const ros::NodeHandle& private_nh) {
  Params params;
  const std::vector<std::string> problems = load_params(read_param_server(private_nh), params);
  if (!problems.empty()) {
    exit_with(problems);
  }
  return params;
}

/// The main() of a node that only answers messages and timers.
template <class Node>
int spin_node(int argc, char** argv, const std::string& name) {
  ros::init(argc, argv, name);
  Node node;
  ros::spin();
  return 0;
}

/// Counts what comes in and what is dropped, and tells /diagnostics: rate, age, drops by reason.
/// A drop is a warning in the next report alone; the counts last.
class InputMonitor {
 public:
  /// `stale_after_s`: an input that is silent for longer is an error; 0: it may stay silent.
  InputMonitor(std::string name, double stale_after_s)
      : name_{std::move(name)}, stale_after_s_{stale_after_s} {}

  void received(const ros::Time& stamp);
  /// Counts a drop and warns, at most every 5 s.
  void dropped(const std::string& reason);
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);
  const std::string& name() const { return name_; }
  std::uint64_t drops() const;

 private:
  std::string name_;
  double stale_after_s_;
  std::uint64_t count_ = 0;
  std::uint64_t count_at_report_ = 0;
  std::uint64_t drops_at_report_ = 0;
  ros::Time last_report_;
  ros::Time last_stamp_;
  ros::Time last_arrival_;
  std::map<std::string, std::uint64_t> drops_;
};

}  // namespace cmn
