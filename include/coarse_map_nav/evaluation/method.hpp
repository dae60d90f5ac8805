// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What is compared: presets of the same navigator, and how much each is told.
#pragma once

#include "coarse_map_nav/evaluation/ablation.hpp"
#include "coarse_map_nav/evaluation/task.hpp"
#include "coarse_map_nav/params.hpp"

#include <string>
#include <vector>

namespace cmn {

struct Method {
  std::string name;
  std::string preset;           ///< file in config/
  bool knows_heading = false;   ///< at the start, whatever the task
  bool knows_pose = false;      ///< at every step
  bool plans_on_world = false;  ///< on the metric world instead of the drawing
  /// Given the drawing at its true scale, in cells of about the robot's step (RMN).
  bool has_metric_map = false;
  /// Goes on when it takes itself to be at the goal; the judge alone ends an episode, as in CMN.
  bool ends_by_judge = false;
  bool has_shared_planner = true;  ///< the lattice, outside of the papers' own settings
  ParamTree changes{};             ///< of the preset: a variant
};

/// Throws std::invalid_argument naming the known methods.
const Method& find_method(const std::string& name);
std::vector<std::string> method_names();

/// The methods of names as ours, ours+no_repair, or ours+all, which is each of the `variants` that
/// changes anything in ours. Throws std::runtime_error with all that is wrong: methods and
/// variants that nobody knows, variants that change nothing or set what is no parameter.
std::vector<Method> methods_named(const std::vector<std::string>& names, const Variants& variants,
                                  const std::string& config_dir);

/// The parameters that a method runs with in a task. `config_dir` holds the presets. Throws
/// std::runtime_error with all that is wrong with the file.
NavigatorParams method_params(const Method& method, const Task& task,
                              const std::string& config_dir);

}  // namespace cmn
