// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmn_journeys: the demo many times over, in process, and how often the robot arrives.

#include "coarse_map_nav/evaluation/episode.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/mapping/places.hpp"
#include "coarse_map_nav/mapping/regions.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tool_main.hpp"
#include <boost/program_options.hpp>

namespace {

namespace po = boost::program_options;

/// A world, its drawing and the goal marked on it.
struct Scene {
  std::string name;
  cmn::World world;
  cmn::CoarseMap map;
  std::vector<cmn::Point2> starts;
  cmn::Place goal;
};

Scene read_scene(const std::string& root, const std::string& name) {
  const std::string world = root + "/worlds/" + name + ".yaml";
  const std::string map = root + "/maps/" + name + ".yaml";
  const cmn::MapPlaces places = cmn::read_places(map);
  const cmn::Place* goal = places.find(places.default_goal);
  const std::vector<cmn::Point2> starts = cmn::read_starts(world);
  if (goal == nullptr || starts.empty()) {
    throw std::runtime_error(name + ": the map needs a default_goal and the world its starts");
  }
  return {name, cmn::World{cmn::read_map(world)}, cmn::largest_region(cmn::read_map(map)).map,
          starts, *goal};
}

cmn::NavigatorParams read_preset(const std::string& path) {
  cmn::NavigatorParams params;
  std::string all;
  for (const std::string& problem : cmn::load_params(cmn::read_param_file(path), params)) {
    all += "\n  " + problem;
  }
  if (!all.empty()) {
    throw std::runtime_error(path + ":" + all);
  }
  return params;
}

/// What came of the journeys in one scene.
struct Tally {
  int said_reached = 0;
  int was_there = 0;     ///< said so, within 1 m of the goal
  int passed_close = 0;  ///< was ever within CMN's 0.4 m of it
  int collisions = 0;
  double driven_m = 0.0;
  double actions = 0.0;
};

void add(const cmn::EpisodeResult& result, cmn::Point2 goal_world, bool verbose, std::uint32_t seed,
         Tally& tally) {
  const bool reached = result.end == cmn::NavigationState::kReached;
  const double off_m = cmn::norm(result.T_world_end.position() - goal_world);
  double closest_m = std::numeric_limits<double>::infinity();
  for (const cmn::EpisodeStep& step : result.steps) {
    closest_m = std::min(closest_m, cmn::norm(step.T_world_robot.position() - goal_world));
  }
  tally.said_reached += reached;
  tally.was_there += reached && off_m <= 1.0;
  tally.passed_close += closest_m <= 0.4;
  tally.collisions += result.collisions;
  tally.driven_m += result.driven_m;
  tally.actions += static_cast<double>(result.steps.size()) - 1.0;
  if (verbose) {
    std::printf("  seed %u: %s, %.2f m from the goal, closest %.2f m, %zu actions: %s\n", seed,
                reached ? "reached" : "failed", off_m, closest_m, result.steps.size() - 1,
                result.reason.c_str());
  }
}

int run(int argc, char** argv) {
  po::options_description options{
      "cmn_journeys --preset config/cmn.yaml [--world home ...] [--seeds 10]\n\n"
      "Drives from the world's starts, at an unknown heading, to the default goal of its drawing.\n"
      "Options"};
  auto add_option = options.add_options();
  add_option("help", "print this");
  add_option("root", po::value<std::string>()->default_value("."), "folder of worlds/ and maps/");
  add_option("preset", po::value<std::string>()->required(), "parameters, yaml");
  add_option("world",
             po::value<std::vector<std::string>>()->multitoken()->default_value(
                 {"home", "office", "lab", "loop"}, "home office lab loop"),
             "names of worlds");
  add_option("seeds", po::value<std::uint32_t>()->default_value(10), "journeys in each, 1 to N");
  add_option("verbose", po::bool_switch(), "a line for each journey");
  po::variables_map given;
  po::store(po::parse_command_line(argc, argv, options), given);
  if (given.count("help") != 0) {
    std::cout << options;
    return EXIT_SUCCESS;
  }
  po::notify(given);

  const cmn::NavigatorParams preset = read_preset(given["preset"].as<std::string>());
  const auto journeys = given["seeds"].as<std::uint32_t>();
  std::printf("%-8s %8s %13s %10s %13s %8s %16s\n", "world", "journeys", "said reached",
              "was there", "passed 0.4 m", "actions", "collisions/100 m");
  for (const std::string& name : given["world"].as<std::vector<std::string>>()) {
    const Scene scene = read_scene(given["root"].as<std::string>(), name);
    Tally tally;
    for (std::uint32_t seed = 1; seed <= journeys; ++seed) {
      cmn::NavigatorParams params = preset;
      params.localization.seed = params.planning.seed = seed;
      std::mt19937 rng{seed};
      const cmn::Point2 start = scene.starts[rng() % scene.starts.size()];
      const double yaw_rad = cmn::yaw(cmn::kHeadings[rng() % 4]);
      const cmn::EpisodeTask task{{start.x, start.y, yaw_rad}, scene.goal.map};
      add(cmn::run_episode(scene.world, cmn::SimulationParams{}, scene.map, params, task, seed),
          scene.goal.world, given["verbose"].as<bool>(), seed, tally);
    }
    std::printf("%-8s %8u %13d %10d %13d %8.0f %16.1f\n", name.c_str(), journeys,
                tally.said_reached, tally.was_there, tally.passed_close, tally.actions / journeys,
                tally.driven_m > 0.0 ? 100.0 * tally.collisions / tally.driven_m : 0.0);
    std::fflush(stdout);
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) { return cmn::tool_main(argc, argv, run); }
