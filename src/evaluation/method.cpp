// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/method.hpp"

#include <algorithm>
#include <exception>
#include <set>
#include <stdexcept>

namespace cmn {
namespace {

const std::vector<Method>& methods() {
  static const std::vector<Method> kMethods = [] {
    Method ours{"ours", "navigator.yaml"};
    ours.has_shared_planner = false;
    Method rolling{"rolling", "rolling.yaml"};
    rolling.has_shared_planner = false;
    Method depth_rolling{"depth_rolling", "depth_rolling.yaml"};
    depth_rolling.has_shared_planner = false;
    Method fused{"fused", "fused.yaml"};
    fused.has_shared_planner = false;
    Method rgb_rolling{"rgb_rolling", "rgb_rolling.yaml"};
    rgb_rolling.has_shared_planner = false;
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
    return std::vector<Method>{ours, rolling, depth_rolling, fused, rgb_rolling, cmn,
                               robb, mcse,    rmn,           rnd,   true_pose,   oracle};
  }();
  return kMethods;
}

/// Whether two methods run with the same parameters.
bool is_same_as(const Method& base, const Method& variant, const std::string& config_dir) {
  const Task& task = find_task("CL");
  const std::vector<ParamDoc> a = list_params(method_params(base, task, config_dir));
  const std::vector<ParamDoc> b = list_params(method_params(variant, task, config_dir));
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const ParamDoc& x, const ParamDoc& y) { return x.default_value == y.default_value; });
}

/// What a task of panoramas sees with, and how such a look is weighed, are those of the preset that
/// the nodes have for it.
void look_by_panorama(const Task& task, const std::string& config_dir, ParamTree& tree) {
  const bool is_in_color = task.observation == ObservationKind::kColorPanorama;
  if (!is_in_color && task.observation != ObservationKind::kDepthPanorama) {
    return;
  }
  for (const auto& [name, value] :
       read_param_file(config_dir + (is_in_color ? "/rgb.yaml" : "/depth.yaml"))) {
    for (const char* part :
         {"perception/source", "perception/accumulate", "localization/scaled/"}) {
      if (name.rfind(part, 0) == 0) {
        tree[name] = value;
      }
    }
  }
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

std::vector<Method> methods_named(const std::vector<std::string>& names, const Variants& variants,
                                  const std::string& config_dir) {
  std::vector<Method> named;
  std::set<std::string> known;
  std::string problems;
  const auto complain = [&](const std::string& problem) {
    problems += (problems.empty() ? "" : "\n  ") + problem;
  };
  const auto add = [&](Method method) {
    if (known.insert(method.name).second) {
      named.push_back(std::move(method));
    } else {
      complain("method " + method.name + " is named twice");
    }
  };
  for (const std::string& name : names) {
    try {
      const std::size_t plus = name.find('+');
      const Method& base = find_method(name.substr(0, plus));
      if (plus == std::string::npos) {
        add(base);
        continue;
      }
      const std::string wanted = name.substr(plus + 1);
      if (wanted != "all" && variants.count(wanted) == 0) {
        std::string list;
        for (const auto& [variant, changes] : variants) {
          list += (list.empty() ? "" : ", ") + variant;
        }
        throw std::invalid_argument("variant \"" + wanted + "\" of " + base.name +
                                    " is none of all, " + list);
      }
      for (const auto& [variant, changes] : variants) {
        if (wanted != "all" && wanted != variant) {
          continue;
        }
        Method method = base;
        method.name += "+" + variant;
        method.changes = changes;
        if (!is_same_as(base, method, config_dir)) {
          add(std::move(method));
        } else if (wanted != "all") {
          complain(method.name + " changes nothing: " + base.name + " is like that");
        }
      }
    } catch (const std::exception& e) {
      complain(e.what());
    }
  }
  if (!problems.empty()) {
    throw std::runtime_error(problems);
  }
  return named;
}

NavigatorParams method_params(const Method& method, const Task& task,
                              const std::string& config_dir) {
  const std::string file = config_dir + "/" + method.preset;
  NavigatorParams params;
  ParamTree tree = read_param_file(file);
  look_by_panorama(task, config_dir, tree);
  for (const auto& [name, value] : method.changes) {
    tree[name] = value;
  }
  std::string faults;
  for (const std::string& problem : load_params(tree, params)) {
    faults += "\n  " + problem;
  }
  if (!faults.empty()) {
    throw std::runtime_error((method.changes.empty() ? file : method.name) + ":" + faults);
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
