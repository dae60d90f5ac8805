// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the tools that read recorded logs are told alike.
#pragma once

#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/evaluation/carmen_log.hpp"
#include "coarse_map_nav/evaluation/odometry_noise.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace cmn {

/// "radish/intel.log.gz" -> "intel".
inline std::string building_of_log(const std::string& path) {
  const std::string name = path.substr(path.find_last_of('/') + 1);
  return name.substr(0, name.find(".log"));
}

/// The line of a building in a file of `NAME: {yaw_deg: .., x: .., y: ..}`. Throws
/// std::runtime_error naming the file and, for an unknown building, those it has.
inline Pose2 world_pose_of(const std::string& path, const std::string& building) {
  try {
    const YAML::Node all = YAML::LoadFile(path);
    const YAML::Node one = all[building];
    if (!one) {
      std::string known;
      for (const auto& entry : all) {
        known += (known.empty() ? "" : ", ") + entry.first.as<std::string>();
      }
      throw std::runtime_error("no building \"" + building + "\" (it has " + known +
                               "); name one with --building");
    }
    return {one["x"].as<double>(), one["y"].as<double>(),
            one["yaw_deg"].as<double>() * kPi / 180.0};
  } catch (const std::exception& e) {
    throw std::runtime_error(path + ": " + e.what());
  }
}

/// "off", or settings as "turn_deg=0.3" that replace those of `noise`. Throws std::runtime_error
/// with every problem.
inline OdometryNoiseParams noise_of(const std::vector<std::string>& settings,
                                    OdometryNoiseParams noise) {
  if (settings == std::vector<std::string>{"off"}) {
    return {0.0, 0.0, 0.0, 0.0, 0.0};
  }
  ParamTree tree;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    const std::string value = equals == std::string::npos ? "" : setting.substr(equals + 1);
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    if (value.empty() || *end != '\0') {
      throw std::runtime_error("--noise " + setting + ": expected off or name=number");
    }
    tree[setting.substr(0, equals)] = number;
  }
  std::string message;
  for (const std::string& problem : load_params(tree, noise)) {
    message += (message.empty() ? "--noise " : "\n--noise ") + problem;
  }
  if (!message.empty()) {
    throw std::runtime_error(message);
  }
  return noise;
}

inline std::string noise_help(const OdometryNoiseParams& noise) {
  std::string text = "off, or any of";
  for (const ParamDoc& doc : list_params(noise)) {
    text += "\n  " + doc.path + "=" + doc.default_value + "  " + doc.text;
  }
  return text;
}

/// Says on stderr what of a log could not be used.
inline void report_faults(const CarmenLog& log) {
  constexpr std::size_t kMalformedShown = 5;
  if (!log.malformed.empty()) {
    std::cerr << log.malformed.size() << " malformed lines skipped:\n";
    for (std::size_t i = 0; i < std::min(kMalformedShown, log.malformed.size()); ++i) {
      std::cerr << "  line " << log.malformed[i].line << ": " << log.malformed[i].text << "\n";
    }
  }
  if (!log.has_clock) {
    std::cerr << "The log's stamps are too coarse to order its lines: 10 lines a second assumed.\n";
  } else if (log.moved_stamps > 0) {
    std::cerr << log.moved_stamps << " stamps out of order: spread between their neighbours.\n";
  }
}

}  // namespace cmn
