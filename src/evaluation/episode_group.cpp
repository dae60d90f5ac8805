// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/episode_group.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace cmn {
namespace {

/// A name that a run gives, and what a reader is shown.
struct Name {
  const char* name;
  const char* shown;
};

constexpr std::array<Name, 13> kTasks{{
    {"CG", "coarse-grid map, true 3 x 3 crop of it seen, known yaw"},
    {"CI", "coarse-grid map, four RGB images, known yaw"},
    {"HD", "hand-drawn map, four RGB images, known yaw"},
    {"CL", "coarse-grid map, LiDAR 360 deg, unknown yaw"},
    {"CD", "coarse-grid map, depth panorama, unknown yaw"},
    {"CF", "coarse-grid map, sensors that look forward only, unknown yaw"},
    {"HL", "hand-drawn map, LiDAR 360 deg, unknown yaw"},
    {"WL", "walls-only map, LiDAR 360 deg, unknown yaw"},
    {"TL", "coarse map turned by 7 deg, LiDAR 360 deg, unknown yaw"},
    {"CLK", "coarse-grid map, LiDAR 360 deg, unknown yaw, kidnapped once"},
    {"CFK", "coarse-grid map, looking forward only, unknown yaw, kidnapped once"},
    {"HLK", "hand-drawn map, LiDAR 360 deg, unknown yaw, kidnapped once"},
    {"WLK", "walls-only map, LiDAR 360 deg, unknown yaw, kidnapped once"},
}};

constexpr std::array<Name, 8> kMethods{{
    {"ours", "ours"},
    {"cmn", "CMN"},
    {"robb", "Robb"},
    {"mcse", "MCSE"},
    {"rmn", "RMN"},
    {"rnd", "RND"},
    {"true_pose", "true pose"},
    {"oracle", "oracle"},
}};

template <std::size_t kCount>
std::size_t rank_in(const std::array<Name, kCount>& names, const std::string& name) {
  return static_cast<std::size_t>(
      std::find_if(names.begin(), names.end(), [&](const Name& n) { return name == n.name; }) -
      names.begin());
}

constexpr const char* kHouses = "houses";
constexpr const char* kFurnished = "furnished houses";

template <class Condition>
std::vector<EpisodeRow> where(const std::vector<EpisodeRow>& rows, Condition&& condition) {
  std::vector<EpisodeRow> result;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(result), condition);
  return result;
}

}  // namespace

std::vector<EpisodeTable> episode_tables(const std::vector<EpisodeRow>& rows) {
  std::map<std::pair<std::pair<std::size_t, std::string>, double>, EpisodeTable> tables;
  for (const EpisodeRow& row : rows) {
    EpisodeTable& table = tables[{{rank_in(kTasks, row.key.task), row.key.task}, row.key.mpp}];
    table.task = row.key.task;
    table.mpp = row.key.mpp;
    table.rows.push_back(row);
  }
  std::vector<EpisodeTable> result;
  for (auto& [key, table] : tables) {
    result.push_back(std::move(table));
  }
  return result;
}

std::vector<std::string> methods_of(const std::vector<EpisodeRow>& rows) {
  std::set<std::pair<std::size_t, std::string>> ranked;
  for (const EpisodeRow& row : rows) {
    ranked.emplace(rank_in(kMethods, base_method(row.key.method)), row.key.method);
  }
  std::vector<std::string> methods;
  for (const auto& [rank, method] : ranked) {
    methods.push_back(method);
  }
  return methods;
}

std::vector<EpisodeRow> of_method(const std::vector<EpisodeRow>& rows, const std::string& method) {
  return where(rows, [&](const EpisodeRow& row) { return row.key.method == method; });
}

std::string base_method(const std::string& method) { return method.substr(0, method.find('+')); }

std::vector<EpisodeRow> without_variants(const std::vector<EpisodeRow>& rows) {
  std::vector<EpisodeRow> whole = where(
      rows, [](const EpisodeRow& row) { return base_method(row.key.method) == row.key.method; });
  return whole.empty() ? rows : whole;
}

std::vector<EpisodeRow> played(const std::vector<EpisodeRow>& rows) {
  return where(rows, [](const EpisodeRow& row) { return row.end != kNoRoute; });
}

std::string building_of(const std::string& world) {
  if (world.rfind("house:", 0) == 0) {
    return kHouses;
  }
  return world.rfind("furnished:", 0) == 0 ? kFurnished : world;
}

std::vector<std::string> buildings_of(const std::vector<EpisodeRow>& rows) {
  std::set<std::pair<bool, std::string>> ranked;
  for (const EpisodeRow& row : rows) {
    const std::string building = building_of(row.key.world);
    ranked.emplace(building != kHouses && building != kFurnished, building);
  }
  std::vector<std::string> buildings;
  for (const auto& [is_building, building] : ranked) {
    buildings.push_back(building);
  }
  return buildings;
}

std::vector<EpisodeRow> of_building(const std::vector<EpisodeRow>& rows,
                                    const std::string& building) {
  return where(rows, [&](const EpisodeRow& row) { return building_of(row.key.world) == building; });
}

std::string method_label(const std::string& method) {
  const std::size_t rank = rank_in(kMethods, method);
  if (rank < kMethods.size()) {
    return kMethods[rank].shown;
  }
  const std::string base = base_method(method);
  return base == method ? method : method_label(base) + method.substr(base.size());
}

std::string task_title(const std::string& task) {
  const std::size_t rank = rank_in(kTasks, task);
  return rank < kTasks.size() ? task + ": " + kTasks[rank].shown : task;
}

}  // namespace cmn
