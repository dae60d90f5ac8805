// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The run of an evaluation on several threads.
#pragma once

#include "coarse_map_nav/evaluation/episode_log.hpp"
#include "coarse_map_nav/evaluation/judged_episode.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "plan.hpp"
#include "worlds.hpp"

namespace cmn {

/// The plan's network where these parameters look in colour, else null.
std::shared_ptr<OccupancyPredictor> predictor_for(const Plan& plan, const NavigatorParams& params);

/// Wall time since some moment [s].
double seconds();

/// The same for all methods, tasks and drawings: what differs between rows is the method. Worlds go
/// by their names, so that a run may be split by worlds, too.
std::uint64_t episode_seed(std::uint64_t seed, const std::string& scene, int index);

/// An episode made ready to be played.
struct Stage {
  Drawing drawing;
  Route route;
  std::uint64_t seed;  ///< that they came from
};
/// The seeds to be tried for an episode, one after the other: a drawing may have closed all ways.
std::vector<std::uint64_t> seeds_of(std::uint64_t seed);
/// By the first of seeds_of() that gives one; none: no start and goal are far enough apart.
std::optional<Stage> stage(const Scene& scene, const Task& task, double mpp,
                           const JudgeParams& judge, std::uint64_t seed);

class ProgressLine;

/// Plays all episodes of a plan on `plan.jobs` threads: the same rows for any number of them.
class Evaluation {
 public:
  /// Reads the worlds and presets. Rows that are in the log already are not run again. Throws
  /// std::runtime_error or std::invalid_argument naming what cannot be done.
  Evaluation(const Plan& plan, EpisodeLog& log);

  /// Until all is done or `is_stopped`, which lets the episodes that are under way end. Throws
  /// std::runtime_error when there is not one episode that could be played.
  void run(const std::function<bool()>& is_stopped);

  /// The number of actions after which every method's episode has ended.
  int horizon() const;

 private:
  /// One start and goal, for all methods.
  struct Job {
    std::size_t world;
    std::size_t task;
    std::size_t mpp;
    int index;
  };

  /// Throws std::runtime_error when methods would see different worlds by one name.
  void open_worlds();
  EpisodeKey key_of(const Job& job, const std::string& method) const;
  void add(const Job& job);
  void work(const std::function<bool()>& is_stopped, ProgressLine& progress);
  void play(const Job& job, std::shared_ptr<OccupancyPredictor>& predictor, ProgressLine& progress);
  void keep(const EpisodeRow& row, ProgressLine& progress);

  const Plan& plan_;
  EpisodeLog& log_;
  std::set<std::string> done_;  ///< ids
  Worlds worlds_;
  std::vector<Job> jobs_;
  /// By task and method.
  std::map<std::string, std::map<std::string, NavigatorParams>> params_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::exception_ptr fault_;
  std::atomic<bool> has_fault_{false};
};

}  // namespace cmn
