// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/method.hpp"

#include <stdexcept>

namespace cmn {
namespace {

const std::vector<Method>& methods() {
  static const std::vector<Method> kMethods = [] {
    Method ours{"ours", "navigator.yaml"};
    ours.has_shared_planner = false;
    Method rolling{"rolling", "rolling.yaml"};
    rolling.has_shared_planner = false;
    Method cmn{"cmn", "cmn_tree.yaml"};
    cmn.knows_heading = cmn.ends_by_judge = true;
    Method robb{"robb", "cmn.yaml"};
    robb.has_shared_planner = false;
    Method mcse{"mcse", "mcse.yaml"};
    mcse.knows_heading = mcse.ends_by_judge = true;
    Method rmn{"rmn", "rmn.yaml"};
    rmn.knows_heading = rmn.has_metric_map = rmn.ends_by_judge = true;
    Method rnd{"rnd", "random.yaml"};
    rnd.has_shared_planner = false;
    rnd.ends_by_judge = true;
    Method true_pose{"true_pose", "rolling.yaml"};
    true_pose.knows_pose = true;
    true_pose.has_shared_planner = false;
    Method oracle{"oracle", "rolling.yaml"};
    oracle.knows_pose = oracle.plans_on_world = true;
    oracle.has_shared_planner = false;
    return std::vector<Method>{ours, rolling, cmn, robb, mcse, rmn, rnd, true_pose, oracle};
  }();
  return kMethods;
}

}  // namespace

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method& method : methods()) {
    names.push_back(method.name);
  }
  return names;
}

const Method& find_method(const std::string& name) {
  std::string known;
  for (const Method& method : methods()) {
    if (method.name == name) {
      return method;
    }
    known += (known.empty() ? "" : ", ") + method.name;
  }
  throw std::invalid_argument("method \"" + name + "\" is none of " + known);
}

NavigatorParams method_params(const Method& method, const Task& task,
                              const std::string& config_dir) {
  const std::string file = config_dir + "/" + method.preset;
  NavigatorParams params;
  std::string faults;
  for (const std::string& problem : load_params(read_param_file(file), params)) {
    faults += "\n  " + problem;
  }
  if (!faults.empty()) {
    throw std::runtime_error(file + ":" + faults);
  }
  if (method.plans_on_world) {
    params.planning.map_repair.drawn_wall_cost = 1000;  // walls of the world are no mistakes
  }
  if (task.has_paper_setting) {
    params.perception.guard.type = "none";
  }
  if (method.has_shared_planner && !task.has_paper_setting) {
    params.planning.policy = "lattice";
    // CMN acts on its estimate from the first step on.
    params.localization.converged_confidence = 0.0;
  }
  return params;
}

}  // namespace cmn
