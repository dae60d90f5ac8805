// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/report_context.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <type_traits>

#include <yaml-cpp/yaml.h>

namespace cmn {
namespace {

/// Names and members, in the order of the file; `visit(name, member)`.
template <class Context, class Visitor>
void visit_entries(Context& context, Visitor&& visit) {
  visit("command", context.command);
  visit("machine", context.machine);
  visit("version", context.version);
  visit("seed", context.seed);
  visit("robot_radius_m", context.robot_radius_m);
  visit("success_radius_m", context.success_radius_m);
  visit("horizon", context.horizon);
  visit("wall_time_s", context.wall_time_s);
  visit("is_interrupted", context.is_interrupted);
}

/// No setting of one name with two values.
bool agree(const ReportContext& a, const ReportContext& b) {
  return std::all_of(a.settings.begin(), a.settings.end(), [&](const auto& setting) {
    return std::all_of(b.settings.begin(), b.settings.end(), [&](const auto& other) {
      return other.first != setting.first || other.second == setting.second;
    });
  });
}

}  // namespace

bool are_alike(const ReportContext& a, const ReportContext& b) {
  return a.seed == b.seed && a.robot_radius_m == b.robot_radius_m &&
         a.success_radius_m == b.success_radius_m && a.horizon == b.horizon &&
         a.version == b.version && agree(a, b);
}

void write_context(const ReportContext& context, const std::string& path) {
  YAML::Emitter yaml;
  yaml.SetDoublePrecision(9);
  yaml << YAML::BeginMap;
  visit_entries(context, [&yaml](const char* name, const auto& value) {
    yaml << YAML::Key << name << YAML::Value << value;
  });
  yaml << YAML::Key << "settings" << YAML::Value << YAML::BeginMap;
  for (const auto& [name, value] : context.settings) {
    yaml << YAML::Key << name << YAML::Value << value;
  }
  yaml << YAML::EndMap << YAML::EndMap;
  std::ofstream file{path};
  file << "# How the episodes beside this file were made.\n" << yaml.c_str() << "\n";
  file.close();
  if (!file) {
    throw std::runtime_error(path + ": cannot be written");
  }
}

ReportContext read_context(const std::string& path) {
  ReportContext context;
  try {
    const YAML::Node yaml = YAML::LoadFile(path);
    visit_entries(context, [&yaml](const char* name, auto& value) {
      value = yaml[name].template as<std::decay_t<decltype(value)>>();
    });
    for (const auto& entry : yaml["settings"]) {
      context.settings.emplace_back(entry.first.as<std::string>(), entry.second.as<std::string>());
    }
  } catch (const YAML::Exception& e) {
    throw std::runtime_error(path + ": cannot be read as a run's description: " + e.what());
  }
  return context;
}

ReportContext merge_contexts(const std::vector<ReportContext>& runs) {
  assert(!runs.empty());
  ReportContext merged = runs.front();
  merged.machine.clear();
  merged.wall_time_s = 0.0;
  std::vector<std::pair<std::string, std::string>> parts;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const ReportContext& run = runs[i];
    if (!are_alike(run, merged)) {
      throw std::runtime_error(
          "these runs cannot be merged, they differ in seed, radii, horizon, "
          "version or settings:\n  " +
          runs.front().command + "\n  " + run.command);
    }
    merged.is_interrupted = merged.is_interrupted || run.is_interrupted;
    for (const auto& setting : run.settings) {
      if (std::find(merged.settings.begin(), merged.settings.end(), setting) ==
          merged.settings.end()) {
        merged.settings.push_back(setting);
      }
    }
    std::array<char, 32> time{};
    std::snprintf(time.data(), time.size(), ", %.0f s", run.wall_time_s);
    parts.emplace_back(
        "part " + std::to_string(i + 1),
        "`" + run.command + "` on " + run.machine + (run.wall_time_s > 0.0 ? time.data() : ""));
  }
  merged.settings.insert(merged.settings.end(), parts.begin(), parts.end());
  return merged;
}

}  // namespace cmn
