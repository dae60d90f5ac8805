// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// An evaluation as it is asked for.
#pragma once

#include "coarse_map_nav/evaluation/judge.hpp"
#include "coarse_map_nav/evaluation/method.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cmn {

struct Plan {
  std::vector<std::string> worlds;
  std::string map;           ///< a drawing of the only world, in place of those that the tasks make
  std::string map_to_world;  ///< the file of its places
  std::vector<std::string> tasks;
  std::vector<double> mpps;
  std::vector<Method> methods;
  int episodes = 0;
  std::uint64_t seed = 1;
  int jobs = 1;
  int shard = 0;
  int shards = 1;
  std::filesystem::path out;
  std::filesystem::path config;
  std::filesystem::path robot;  ///< its description: where its sensors are
  std::string model;            ///< the network of methods that look in colour
  bool resume = false;
  JudgeParams judge;
};

}  // namespace cmn
