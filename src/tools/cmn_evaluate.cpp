// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmn_evaluate: every method on every building, judged; the tables by which this package is
/// judged.

#include "coarse_map_nav/evaluation/judged_episode.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <boost/program_options.hpp>

namespace {

namespace fs = std::filesystem;
namespace po = boost::program_options;

/// What is asked for.
struct Plan {
  std::vector<std::string> worlds;
  std::vector<std::string> tasks;
  std::vector<double> mpps;
  std::vector<std::string> methods;
  int episodes = 0;
  std::uint64_t seed = 1;
  int jobs = 1;
  int shard = 0;
  int shards = 1;
  fs::path out;
  fs::path config;
  bool resume = false;
  cmn::JudgeParams judge;
};

/// One start and goal, for all methods.
struct Job {
  std::size_t world;
  std::size_t task;
  std::size_t mpp;
  int index;
};

std::uint64_t mixed(std::uint64_t value) {  // SplitMix64 (Steele et al. 2014)
  value += 0x9e3779b97f4a7c15U;
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31U);
}

/// The same for all methods, tasks and drawings: what differs between rows is the method.
std::uint64_t episode_seed(std::uint64_t seed, std::size_t world, int index) {
  return mixed(mixed(mixed(seed) + world) + static_cast<std::uint64_t>(index));
}

std::vector<std::string> split(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const std::string& text : texts) {
    std::istringstream in{text};
    for (std::string part; std::getline(in, part, ',');) {
      parts.push_back(part);
    }
  }
  return parts;
}

/// The presets: beside the installed program, or in the source tree that it was built from.
fs::path find_config() {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  for (fs::path at = program.parent_path(); at != at.root_path(); at = at.parent_path()) {
    for (const fs::path& dir : {at / "share" / "coarse_map_nav" / "config", at / "config"}) {
      if (fs::exists(dir / "cmn.yaml")) {
        return dir;
      }
    }
  }
  throw std::runtime_error("the folder of presets was not found: give --config");
}

std::unique_ptr<cmn::Scene> read_scene(const std::string& path, const cmn::JudgeParams& judge) {
  try {
    return std::make_unique<cmn::Scene>(fs::path{path}.stem().string(), cmn::read_map(path),
                                        std::nullopt, judge);
  } catch (const std::exception& e) {
    const std::string why = e.what();
    throw std::runtime_error(why.find(path) == std::string::npos ? path + ": " + why : why);
  }
}

/// Writes rows as they come, so that an interrupted run keeps what is done.
class EpisodeLog {
 public:
  EpisodeLog(const fs::path& out, bool resume) : path_{out / "episodes.csv"} {
    std::error_code error;
    fs::create_directories(out, error);
    if (fs::exists(path_) && !resume) {
      throw std::runtime_error(path_.string() + " exists: --resume goes on with it, or give " +
                               "another --out");
    }
    if (resume && fs::exists(path_)) {
      std::ifstream in{path_};
      rows_ = cmn::read_episodes(in, path_.string());
    }
    rewrite();
  }

  const std::vector<cmn::EpisodeRow>& rows() const { return rows_; }
  std::set<std::string> done() const {
    std::set<std::string> ids;
    for (const cmn::EpisodeRow& row : rows_) {
      ids.insert(row.key.id());
    }
    return ids;
  }
  void add(const cmn::EpisodeRow& row) {
    rows_.push_back(row);
    stream_ << cmn::csv_line(row) << "\n" << std::flush;
  }
  /// In the order of the keys: the same file for any number of jobs.
  void finish() {
    std::sort(rows_.begin(), rows_.end(),
              [](const auto& a, const auto& b) { return a.key < b.key; });
    rewrite();
  }

 private:
  void rewrite() {
    stream_ = std::ofstream{path_, std::ios::trunc};
    stream_ << cmn::csv_header() << "\n";
    for (const cmn::EpisodeRow& row : rows_) {
      stream_ << cmn::csv_line(row) << "\n";
    }
    stream_.flush();
    if (!stream_) {
      throw std::runtime_error("cannot write " + path_.string());
    }
  }

  fs::path path_;
  std::ofstream stream_;
  std::vector<cmn::EpisodeRow> rows_;
};

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Plays all jobs of the plan on `plan.jobs` threads.
class Evaluation {
 public:
  Evaluation(const Plan& plan, EpisodeLog& log) : plan_{plan}, log_{log}, done_{log.done()} {
    for (const std::string& world : plan.worlds) {
      scenes_.push_back(read_scene(world, plan.judge));
    }
    for (std::size_t world = 0; world < plan.worlds.size(); ++world) {
      for (std::size_t task = 0; task < plan.tasks.size(); ++task) {
        for (std::size_t mpp = 0; mpp < plan.mpps.size(); ++mpp) {
          for (int index = plan.shard; index < plan.episodes; index += plan.shards) {
            jobs_.push_back({world, task, mpp, index});
          }
        }
      }
    }
    for (const std::string& name : plan.tasks) {
      for (const std::string& method : plan.methods) {
        params_[name][method] = cmn::method_params(cmn::find_method(method), cmn::find_task(name),
                                                   plan.config.string());
      }
    }
  }

  void run() {
    std::vector<std::thread> workers;
    for (int i = 0; i < plan_.jobs; ++i) {
      workers.emplace_back([this] { work(); });
    }
    for (std::thread& worker : workers) {
      worker.join();
    }
    if (fault_) {
      std::rethrow_exception(fault_);
    }
  }

 private:
  void work() {
    try {
      for (std::size_t i; !has_fault_ && (i = next_++) < jobs_.size();) {
        play(jobs_[i]);
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock{mutex_};
      fault_ = std::current_exception();
      has_fault_ = true;
    }
  }

  void play(const Job& job) {
    const cmn::Scene& scene = *scenes_[job.world];
    const cmn::Task& task = cmn::find_task(plan_.tasks[job.task]);
    cmn::EpisodeKey key;
    key.task = task.name;
    key.world = scene.name;
    key.mpp = plan_.mpps[job.mpp];
    key.index = job.index;
    key.seed = episode_seed(plan_.seed, job.world, job.index);
    std::optional<cmn::Drawing> drawing;
    std::optional<cmn::Route> route;
    for (const std::string& name : plan_.methods) {
      key.method = name;
      if (done_.count(key.id()) != 0) {
        continue;
      }
      if (!drawing) {
        drawing = cmn::draw(task, scene.map, scene.walls ? &*scene.walls : nullptr, key.mpp,
                            static_cast<std::uint32_t>(key.seed));
        route = cmn::sample_route(scene, *drawing, plan_.judge, key.seed);
      }
      if (!route) {
        throw std::runtime_error(key.world + ": no start and goal lie " +
                                 std::to_string(plan_.judge.least_way_m) + " m to " +
                                 std::to_string(plan_.judge.most_way_m) + " m apart");
      }
      const cmn::EpisodeRow row =
          cmn::run_judged_episode(scene, task, *drawing, *route, cmn::find_method(name),
                                  params_.at(task.name).at(name), plan_.judge, key, seconds);
      const std::lock_guard<std::mutex> lock{mutex_};
      log_.add(row);
    }
  }

  const Plan& plan_;
  EpisodeLog& log_;
  std::set<std::string> done_;
  std::vector<std::unique_ptr<cmn::Scene>> scenes_;
  std::vector<Job> jobs_;
  std::map<std::string, std::map<std::string, cmn::NavigatorParams>> params_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::exception_ptr fault_;
  std::atomic<bool> has_fault_{false};
};

void print_results(const Plan& plan, const std::vector<cmn::EpisodeRow>& rows) {
  for (const std::string& task : plan.tasks) {
    for (const double mpp : plan.mpps) {
      for (const std::string& method : plan.methods) {
        int episodes = 0;
        int successes = 0;
        double spl = 0.0;
        double step_ms = 0.0;
        for (const cmn::EpisodeRow& row : rows) {
          if (row.key.task == task && row.key.mpp == mpp && row.key.method == method) {
            ++episodes;
            successes += row.is_success;
            spl += row.spl();
            step_ms += row.step_ms;
          }
        }
        const int n = std::max(1, episodes);
        std::fprintf(stderr, "%s %.3f ms a step\n", method.c_str(), step_ms / n);
        std::printf("RESULT task=%s mpp=%.2f method=%s SR=%.3f SPL=%.3f episodes=%d\n",
                    task.c_str(), mpp, method.c_str(), static_cast<double>(successes) / n, spl / n,
                    episodes);
      }
    }
  }
}

int run(int argc, char** argv) {
  po::options_description options{
      "cmn_evaluate --world W.yaml [--world ...] --task CL --mpp 0.4 --method ours,cmn --out "
      "DIR\n\n"
      "Options"};
  auto add_option = options.add_options();
  add_option("help", "print this");
  add_option("world", po::value<std::vector<std::string>>()->multitoken()->composing(),
             "metric worlds, map_server yaml");
  add_option(
      "task",
      po::value<std::vector<std::string>>()->multitoken()->composing()->default_value({"CL"}, "CL"),
      "CG, CL, CF, HL, WL; several with commas");
  add_option("mpp",
             po::value<std::vector<std::string>>()->multitoken()->composing()->default_value(
                 {"0.4"}, "0.4"),
             "[m/cell] of the drawing; several with commas");
  add_option("method",
             po::value<std::vector<std::string>>()->multitoken()->composing()->default_value(
                 {"ours"}, "ours"),
             "several with commas");
  add_option("episodes", po::value<int>()->default_value(50), "in each world");
  add_option("seed", po::value<std::uint64_t>()->default_value(1), "of starts, goals and noise");
  add_option("jobs", po::value<int>()->default_value(1), "threads; the result is the same for any");
  add_option("shard", po::value<std::string>()->default_value("0/1"), "i/n: every n-th episode");
  add_option("out", po::value<std::string>()->required(), "folder of episodes.csv and the report");
  add_option("config", po::value<std::string>(), "folder of the presets");
  add_option("resume", po::bool_switch(), "go on with what lies in --out");
  po::variables_map given;
  po::store(po::parse_command_line(argc, argv, options), given);
  if (given.count("help") != 0) {
    std::cout << options;
    return EXIT_SUCCESS;
  }
  po::notify(given);
  Plan plan;
  if (given.count("world") != 0) {
    plan.worlds = given["world"].as<std::vector<std::string>>();
  }
  plan.tasks = split(given["task"].as<std::vector<std::string>>());
  plan.methods = split(given["method"].as<std::vector<std::string>>());
  for (const std::string& mpp : split(given["mpp"].as<std::vector<std::string>>())) {
    plan.mpps.push_back(std::stod(mpp));
  }
  plan.episodes = given["episodes"].as<int>();
  plan.seed = given["seed"].as<std::uint64_t>();
  plan.jobs = std::max(1, given["jobs"].as<int>());
  if (std::sscanf(given["shard"].as<std::string>().c_str(), "%d/%d", &plan.shard, &plan.shards) !=
          2 ||
      plan.shards < 1 || plan.shard < 0 || plan.shard >= plan.shards) {
    throw std::runtime_error("--shard is i/n with 0 <= i < n");
  }
  plan.out = given["out"].as<std::string>();
  plan.config =
      given.count("config") != 0 ? fs::path{given["config"].as<std::string>()} : find_config();
  plan.resume = given["resume"].as<bool>();

  EpisodeLog log{plan.out, plan.resume};
  Evaluation evaluation{plan, log};
  evaluation.run();
  log.finish();
  print_results(plan, log.rows());
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& e) {
    std::cerr << "cmn_evaluate: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
}
