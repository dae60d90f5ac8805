// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation.hpp"

#include "coarse_map_nav/evaluation/episode_group.hpp"
#include "coarse_map_nav/evaluation/progress.hpp"
#include "coarse_map_nav/learning/torch_predictor.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include <unistd.h>

namespace cmn {

/// The line on the terminal. Silent when nobody looks.
class ProgressLine {
 public:
  ProgressLine(std::size_t done_before, std::size_t total) {
    progress_.total = total;
    progress_.done = progress_.done_before = done_before;
  }
  ~ProgressLine() {
    if (is_shown_) {
      std::cerr << "\n";
    }
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void count(bool is_success) {
    ++progress_.done;
    successes_ += is_success;
    progress_.elapsed_s = seconds() - start_s_;
    progress_.success_share = static_cast<double>(successes_) /
                              static_cast<double>(progress_.done - progress_.done_before);
    const bool is_due = progress_.elapsed_s - shown_s_ > 0.2 || progress_.done == progress_.total;
    if (isatty(STDERR_FILENO) == 1 && is_due) {
      const std::string line = progress_line(progress_);
      std::cerr << "\r" << line << std::string(79 - std::min<std::size_t>(79, line.size()), ' ');
      shown_s_ = progress_.elapsed_s;
      is_shown_ = true;
    }
  }

 private:
  Progress progress_;
  double start_s_ = seconds();
  double shown_s_ = 0.0;
  std::size_t successes_ = 0;
  bool is_shown_ = false;
};

namespace {

std::uint64_t mixed(std::uint64_t value) {  // SplitMix64 (Steele et al. 2014)
  value += 0x9e3779b97f4a7c15U;
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31U);
}

}  // namespace

std::uint64_t episode_seed(std::uint64_t seed, const std::string& scene, int index) {
  std::uint64_t value = mixed(seed);
  for (const char letter : scene) {
    value = mixed(value + static_cast<unsigned char>(letter));
  }
  return mixed(value + static_cast<std::uint64_t>(index));
}

std::vector<std::uint64_t> seeds_of(std::uint64_t seed) {
  return {seed, mixed(seed + 1), mixed(seed + 2)};
}

std::optional<Stage> stage(const Scene& scene, const Task& task, double mpp,
                           const JudgeParams& judge, std::uint64_t seed) {
  for (const std::uint64_t tried : seeds_of(seed)) {
    Drawing drawing =
        scene.drawing ? *scene.drawing
                      : draw(task, scene.map, scene.walls ? &*scene.walls : nullptr, mpp,
                             static_cast<std::uint32_t>(tried), judge.simulation.robot.radius_m);
    if (const auto route = sample_route(scene, drawing, judge, tried)) {
      return Stage{std::move(drawing), *route, tried};
    }
  }
  return std::nullopt;
}

std::shared_ptr<OccupancyPredictor> predictor_for(const Plan& plan, const NavigatorParams& params) {
  return params.perception.uses_color() ? load_predictor(plan.model) : nullptr;
}

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Evaluation::Evaluation(const Plan& plan, EpisodeLog& log) : plan_{plan}, log_{log}, worlds_{plan} {
  for (const std::string& name : plan.tasks) {
    for (const Method& method : plan.methods) {
      params_[name][method.name] = method_params(method, find_task(name), plan.config.string());
    }
  }
  open_worlds();
  for (std::size_t world = 0; world < plan.worlds.size(); ++world) {
    for (std::size_t task = 0; task < plan.tasks.size(); ++task) {
      for (std::size_t mpp = 0; mpp < plan.mpps.size(); ++mpp) {
        for (int index = plan.shard; index < plan.episodes; index += plan.shards) {
          add({world, task, mpp, index});
        }
      }
    }
  }
}

void Evaluation::open_worlds() {
  std::set<std::string> names;
  std::set<std::pair<std::string, bool>> seen;  // worlds, with heights or without
  for (const std::string& world : plan_.worlds) {
    if (!names.insert(scene_name(world)).second) {
      throw std::runtime_error(world + ": another world is called " + scene_name(world));
    }
    for (const auto& [task, methods] : params_) {
      std::map<bool, std::string> examples;  // of those that see it with heights, and without
      for (const auto& [method, params] : methods) {
        examples[has_heights(world, params)] = method;
        seen.emplace(world, has_heights(world, params));
      }
      if (examples.size() > 1 && changes_with_heights(world)) {
        throw std::runtime_error(world + " has heights for " + examples[true] + " and none for " +
                                 examples[false] + " in " + task + ": furnished:" +
                                 world.substr(world.find(':') + 1) + " has them for all");
      }
    }
  }
  const double finest = *std::min_element(plan_.mpps.begin(), plan_.mpps.end());
  for (const auto& [world, with_heights] : seen) {
    const double cell_m = worlds_.open(world, with_heights).map.resolution();
    if (finest < cell_m) {
      std::ostringstream text;
      text << "--mpp " << finest << " is finer than " << world << ", which has cells of " << cell_m
           << " m";
      throw std::runtime_error(text.str());
    }
  }
}

int Evaluation::horizon() const {
  int most = 0;
  for (const auto& [task, methods] : params_) {
    for (const auto& [method, params] : methods) {
      most = std::max(most, params.planning.max_actions);
    }
  }
  return most;
}

void Evaluation::run(const std::function<bool()>& is_stopped) {
  ProgressLine progress{done_.size(), jobs_.size() * plan_.methods.size()};
  std::vector<std::thread> workers;
  for (int i = 0; i < plan_.jobs; ++i) {
    workers.emplace_back([&] { work(is_stopped, progress); });
  }
  for (std::thread& worker : workers) {
    worker.join();
  }
  if (fault_) {
    std::rethrow_exception(fault_);
  }
  if (!log_.rows().empty() && played(log_.rows()).empty()) {
    const EpisodeKey& first = log_.rows().front().key;
    std::ostringstream text;
    text << first.world << ": no start and goal lie " << plan_.judge.least_way_m << " m to "
         << plan_.judge.most_way_m << " m apart with the goal on free ground of the map at "
         << first.mpp << " m/cell; nor does any other episode have them";
    throw std::runtime_error(text.str());
  }
}

EpisodeKey Evaluation::key_of(const Job& job, const std::string& method) const {
  EpisodeKey key;
  key.task = plan_.tasks[job.task];
  key.world = scene_name(plan_.worlds[job.world]);
  key.mpp = plan_.mpps[job.mpp];
  key.method = method;
  key.index = job.index;
  key.seed = episode_seed(plan_.seed, key.world, key.index);
  return key;
}

void Evaluation::add(const Job& job) {
  jobs_.push_back(job);
  for (const Method& method : plan_.methods) {
    const EpisodeKey key = key_of(job, method.name);
    if (const EpisodeRow* row = log_.find(key.id())) {
      const std::vector<std::uint64_t> seeds = seeds_of(key.seed);
      if (std::find(seeds.begin(), seeds.end(), row->key.seed) == seeds.end()) {
        throw std::runtime_error(key.id() + " was run with another --seed: --resume needs the " +
                                 "options of the run that it goes on with");
      }
      done_.insert(key.id());
    }
  }
}

void Evaluation::work(const std::function<bool()>& is_stopped, ProgressLine& progress) {
  try {
    std::shared_ptr<OccupancyPredictor> predictor;  // a network is nobody else's meanwhile
    for (std::size_t i; !has_fault_ && !is_stopped() && (i = next_++) < jobs_.size();) {
      play(jobs_[i], predictor, progress);
    }
  } catch (...) {
    const std::lock_guard<std::mutex> lock{mutex_};
    fault_ = std::current_exception();
    has_fault_ = true;
  }
}

void Evaluation::play(const Job& job, std::shared_ptr<OccupancyPredictor>& predictor,
                      ProgressLine& progress) {
  const Task& task = find_task(plan_.tasks[job.task]);
  std::optional<Stage> ready;
  bool is_staged = false;
  for (const Method& method : plan_.methods) {
    EpisodeRow row;
    row.key = key_of(job, method.name);
    if (done_.count(row.key.id()) != 0) {
      continue;
    }
    const NavigatorParams& params = params_.at(task.name).at(method.name);
    const std::string& world = plan_.worlds[job.world];
    const Scene& scene = worlds_.opened(world, has_heights(world, params));
    if (!is_staged) {
      ready = stage(scene, task, row.key.mpp, plan_.judge, row.key.seed);
      is_staged = true;
    }
    if (!predictor) {
      predictor = predictor_for(plan_, params);
    }
    if (ready) {
      row.key.seed = ready->seed;
      row = run_judged_episode(scene, task, ready->drawing, ready->route, method, params,
                               plan_.judge, row.key, seconds, {}, predictor);
    } else {
      row.end = kNoRoute;
    }
    keep(row, progress);
  }
}

void Evaluation::keep(const EpisodeRow& row, ProgressLine& progress) {
  const std::lock_guard<std::mutex> lock{mutex_};
  log_.add(row);
  progress.count(row.is_success);
}

}  // namespace cmn
