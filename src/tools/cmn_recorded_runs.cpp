// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmn_recorded_runs: how often a real robot is found, from many moments of recorded logs.

#include "coarse_map_nav/evaluation/recorded_run.hpp"
#include "coarse_map_nav/mapping/downsample.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/mapping/turned_map.hpp"

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "carmen_options.hpp"
#include "tool_main.hpp"
#include <boost/program_options.hpp>

namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

struct Method {
  std::string name;
  cmn::NavigatorParams params;
};
struct Building {
  std::string name;
  cmn::RecordedDrive drive;
  cmn::CoarseMap drawing;
  std::vector<std::size_t> starts;
};

/// A preset, and "path=number" settings on top of it. Throws std::runtime_error with every problem.
Method method_of(const std::string& preset, const std::vector<std::string>& settings) {
  cmn::ParamTree tree = cmn::read_param_file(preset);
  std::string name = fs::path{preset}.stem().string();
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    const std::string value = equals == std::string::npos ? "" : setting.substr(equals + 1);
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    if (value.empty()) {
      throw std::runtime_error("--set " + setting + ": expected path=value");
    }
    const std::string path = setting.substr(0, equals);
    tree[path] = *end == '\0'                          ? cmn::ParamValue{number}
                 : value == "true" || value == "false" ? cmn::ParamValue{value == "true"}
                                                       : cmn::ParamValue{value};
    name += ", " + path.substr(path.find_last_of('/') + 1) + " " + value;
  }
  Method method{name, {}};
  std::string faults;
  for (const std::string& problem : cmn::load_params(tree, method.params)) {
    faults += "\n  " + problem;
  }
  if (!faults.empty()) {
    throw std::runtime_error(preset + ":" + faults);
  }
  return method;
}

/// Calls `job` for 0 .. count - 1 from `threads` threads; rethrows the first fault.
void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& job) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr fault;
  std::mutex mutex;
  std::vector<std::thread> workers;
  for (int i = 0; i < threads; ++i) {
    workers.emplace_back([&] {
      try {
        for (std::size_t at = next++; at < count; at = next++) {
          job(at);
        }
      } catch (...) {
        const std::lock_guard<std::mutex> lock{mutex};
        fault = std::current_exception();
        next = count;
      }
    });
  }
  for (std::thread& worker : workers) {
    worker.join();
  }
  if (fault) {
    std::rethrow_exception(fault);
  }
}

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream file{path};
  file << text;
  if (!file.flush()) {
    throw std::runtime_error(path.string() + ": cannot be written");
  }
}

double positive(const po::variables_map& given, const std::string& option) {
  const auto value = given[option].as<double>();
  if (!(value > 0.0)) {
    throw std::runtime_error("--" + option + " is not above 0");
  }
  return value;
}

int run(int argc, char** argv) {
  cmn::RecordedRunParams params;
  po::options_description options{
      "cmn_recorded_runs LOG.log.gz [LOG ...] --worlds DIR --preset navigator.yaml --out DIR\n\n"
      "Plays recorded LiDAR logs (CARMEN; named after their building) to perception and localizer\n"
      "of a preset, in process, from random scans on, with an unknown start. A run is a success\n"
      "when, after --find metres and for the next --hold, every estimate is within --within of "
      "the\n"
      "truth and faces the right quarter. Writes runs.csv, looks.csv, table.md and error.svg. "
      "Options"};
  auto add = options.add_options();
  add("help", "print this");
  add("log", po::value<std::vector<std::string>>(), "the logs");
  add("worlds", po::value<std::string>(),
      "folder of the buildings' metric maps, NAME.yaml, and of log_to_world.yaml, which takes the "
      "logs into them");
  add("preset", po::value<std::vector<std::string>>()->composing(), "parameters; may be repeated");
  add("set", po::value<std::vector<std::string>>()->composing(),
      "path=value: a parameter of all presets, as localization/scaled/headings=36");
  add("mpp", po::value<double>()->default_value(0.4), "[m/cell] of the drawing");
  add("turn", po::value<double>()->default_value(0.0),
      "how far the drawing's axes are turned to the left against the walls [deg]");
  add("runs", po::value<int>()->default_value(50), "from each log");
  add("seed", po::value<std::uint32_t>()->default_value(1), "of starts and drift");
  add("find", po::value<double>()->default_value(params.find_m), "[m]");
  add("hold", po::value<double>()->default_value(params.hold_m), "[m]");
  add("within", po::value<double>()->default_value(params.within_m), "[m]");
  add("noise", po::value<std::vector<std::string>>()->multitoken(),
      cmn::noise_help(params.noise).c_str());
  add("jobs", po::value<int>()->default_value(1), "threads; the result is the same for any");
  add("out", po::value<std::string>(), "folder for the results");
  po::variables_map given;
  po::store(po::command_line_parser(argc, argv)
                .options(options)
                .positional(po::positional_options_description{}.add("log", -1))
                .style(po::command_line_style::unix_style ^ po::command_line_style::allow_short)
                .run(),
            given);
  po::notify(given);
  if (given.count("help") != 0 || argc == 1) {
    std::cout << options;
    return argc == 1 ? EXIT_FAILURE : EXIT_SUCCESS;
  }
  for (const char* needed : {"log", "worlds", "preset", "out"}) {
    if (given.count(needed) == 0) {
      throw std::runtime_error(std::string{"--"} + needed + " is needed; --help explains");
    }
  }
  const int runs = given["runs"].as<int>();
  const int jobs = given["jobs"].as<int>();
  if (runs < 1 || jobs < 1) {
    throw std::runtime_error("--runs and --jobs are at least 1");
  }
  params.find_m = positive(given, "find");
  params.hold_m = positive(given, "hold");
  params.within_m = positive(given, "within");
  if (given.count("noise") != 0) {
    params.noise = cmn::noise_of(given["noise"].as<std::vector<std::string>>(), params.noise);
  }
  const auto settings = given.count("set") != 0 ? given["set"].as<std::vector<std::string>>()
                                                : std::vector<std::string>{};
  std::vector<Method> methods;
  for (const std::string& preset : given["preset"].as<std::vector<std::string>>()) {
    methods.push_back(method_of(preset, settings));
  }
  const fs::path worlds = given["worlds"].as<std::string>();
  const double turn_rad = given["turn"].as<double>() * cmn::kPi / 180.0;
  const auto seed = given["seed"].as<std::uint32_t>();
  std::vector<Building> buildings;
  for (const std::string& path : given["log"].as<std::vector<std::string>>()) {
    const std::string name = cmn::building_of_log(path);
    const cmn::CarmenLog log = cmn::read_carmen_log(path);
    cmn::report_faults(log);
    cmn::RecordedDrive drive{log,
                             cmn::world_pose_of((worlds / "log_to_world.yaml").string(), name)};
    const cmn::CoarseMap world = cmn::read_map((worlds / (name + ".yaml")).string());
    cmn::CoarseMap drawing =
        cmn::downsampled(cmn::turned_map(world, turn_rad), given["mpp"].as<double>());
    try {
      auto starts = cmn::random_starts(drive, params.find_m + params.hold_m, runs, seed);
      buildings.push_back({name, std::move(drive), std::move(drawing), std::move(starts)});
    } catch (const std::invalid_argument& e) {
      throw std::runtime_error(path + ": " + e.what());
    }
  }
  const fs::path out{given["out"].as<std::string>()};
  fs::create_directories(out);

  const std::size_t each = static_cast<std::size_t>(runs);
  std::vector<cmn::RecordedRun> all(buildings.size() * methods.size() * each);
  for_each_index(all.size(), jobs, [&](std::size_t i) {
    const Building& building = buildings[i / each / methods.size()];
    const Method& method = methods[i / each % methods.size()];
    const std::size_t index = i % each;
    const std::size_t first = building.starts[index];
    all[i] = {building.name, method.name, static_cast<int>(index),
              building.drive.stamps_s[building.drive.scans[first].pose],
              cmn::play(building.drive, first, building.drawing, method.params, params,
                        seed + static_cast<std::uint32_t>(index))};
  });
  write_file(out / "runs.csv", cmn::csv_of(all, params));
  write_file(out / "looks.csv", cmn::looks_csv_of(all));
  write_file(out / "table.md", cmn::table_of(all, params));
  write_file(out / "error.svg", cmn::recorded_plot(all, params));
  std::cout << cmn::table_of(all, params) << cmn::results_of(all, params);
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) { return cmn::tool_main(argc, argv, run); }
