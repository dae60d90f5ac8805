// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Judged episodes that nobody has driven, for tests of what is made of them.
#pragma once

#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/evaluation/episode_row.hpp"

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace cmn {

/// An episode that failed after 500 actions and 60 m.
inline EpisodeRow failed_episode(const std::string& method = "ours", int index = 0) {
  EpisodeRow row;
  row.key = {"CL", "intel", 0.4, method, index, 7};
  row.shortest_m = 4.0;
  row.actions = 500;
  row.driven_m = 60.0;
  row.closest_m = 2.0;
  row.step_ms = 2.0;
  row.end = "horizon";
  return row;
}

/// One that came to the goal.
inline EpisodeRow successful_episode(double shortest_m, double driven_m,
                                     const std::string& method = "ours", int index = 0) {
  EpisodeRow row = failed_episode(method, index);
  row.shortest_m = shortest_m;
  row.is_success = true;
  row.success_driven_m = row.driven_m = driven_m;
  row.actions = row.success_actions = static_cast<int>(driven_m / 0.15);
  row.closest_m = 0.3;
  row.end = "reached";
  return row;
}

/// What a whole evaluation could look like: methods of plausible strength in three buildings.
inline std::vector<EpisodeRow> fake_evaluation(std::uint64_t seed, int episodes,
                                               const std::vector<std::string>& tasks = {"CL"},
                                               const std::vector<double>& mpps = {0.3, 0.4, 0.5}) {
  const std::vector<std::pair<std::string, double>> methods{
      {"ours", 0.9}, {"cmn", 0.25}, {"robb", 0.45},      {"mcse", 0.4},
      {"rmn", 0.33}, {"rnd", 0.02}, {"true_pose", 0.96}, {"oracle", 1.0}};
  std::mt19937_64 rng{seed};
  std::vector<EpisodeRow> rows;
  for (const std::string& task : tasks) {
    for (const double mpp : mpps) {
      for (const char* world : {"house:3", "house:4", "fhw", "intel"}) {
        for (int i = 0; i < episodes; ++i) {
          const double shortest_m = 3.0 + 17.0 * draw_uniform(rng);
          for (const auto& [method, strength] : methods) {
            EpisodeRow row = failed_episode(method, i);
            const bool has_belief = method != "rnd" && method != "oracle" && method != "true_pose";
            const double detour = 1.0 + 0.3 * std::abs(draw_normal(rng)) / strength;
            if (draw_uniform(rng) < strength * (1.1 - 0.5 * (mpp - 0.3)) - 0.1) {
              row = successful_episode(shortest_m, shortest_m * detour, method, i);
              row.is_declared = row.is_declared_right = method != "rnd";
            } else {
              row.is_declared = draw_uniform(rng) < 0.2;
            }
            if (has_belief && draw_uniform(rng) < 0.9) {
              row.converged_actions = static_cast<int>(20.0 / strength * draw_uniform(rng));
              row.converged_driven_m = 0.1 * row.converged_actions;
              row.is_falsely_converged = draw_uniform(rng) > strength;
            }
            row.shortest_m = shortest_m;
            row.key.task = task;
            row.key.mpp = mpp;
            row.key.world = world;
            row.key.seed = seed + static_cast<std::uint64_t>(i);
            row.collisions = static_cast<int>(draw_index(rng, 3));
            row.step_ms = 0.4 + draw_uniform(rng);
            rows.push_back(row);
          }
        }
      }
    }
  }
  return rows;
}

}  // namespace cmn
