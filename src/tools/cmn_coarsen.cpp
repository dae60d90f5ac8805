// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmn_coarsen: a metric map -> the coarse map that a robot is given.

#include "coarse_map_nav/evaluation/drawing.hpp"
#include "coarse_map_nav/evaluation/route_sampler.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/mapping/map_writer.hpp"
#include "coarse_map_nav/mapping/regions.hpp"
#include "coarse_map_nav/mapping/turned_map.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>
#include <random>
#include <stdexcept>
#include <string>

#include "tool_main.hpp"
#include <boost/program_options.hpp>

namespace {

namespace po = boost::program_options;

constexpr double kPlacesApart = 2.0;    // [m]
constexpr double kGoalClearance = 0.3;  // [m]

void print_place(std::ostream& out, const std::string& name, cmn::Point2 world,
                 const cmn::Drawing& drawing) {
  const cmn::Point2 map = drawing.world_to_map(world);
  out << "  " << name << ": {world: [" << world.x << ", " << world.y << "], map: [" << map.x << ", "
      << map.y << "]}\n";
}

/// The block that read_places() knows, for a lattice over the free ground.
void print_places(std::ostream& out, const cmn::CoarseMap& world, const cmn::Drawing& drawing) {
  out << "places:\n";
  const int stride = std::max(1, static_cast<int>(std::lround(kPlacesApart / world.resolution())));
  for (int y = stride / 2; y < world.height(); y += stride) {
    for (int x = stride / 2; x < world.width(); x += stride) {
      if (world.is_free({x, y})) {
        print_place(out, "p" + std::to_string(x / stride) + "_" + std::to_string(y / stride),
                    world.center_of({x, y}), drawing);
      }
    }
  }
}

void require_written(std::ofstream& out, const std::string& path) {
  if (!out.flush()) {
    throw std::runtime_error(path + ": cannot be written; does the folder exist?");
  }
}

/// Where points of the world lie on a drawing out of proportion, beside it.
void write_places(const std::string& path, const std::string& world_path,
                  const cmn::CoarseMap& world, const cmn::Drawing& drawing) {
  std::ofstream out{path};
  out << std::setprecision(9) << "# The truth about a drawing, for scoring; no robot may read it.\n"
      << "# map metres a world metre, on average\nscale: " << drawing.scale()
      << "\nquarter_turns: " << drawing.quarter_turns() << "\n# drawn from " << world_path << "\n";
  print_places(out, world, drawing);
  require_written(out, path);
}

/// The same in the drawing's own file, with a goal: a place where a robot fits, drawn from the
/// seed.
void append_goal(const std::string& path, const std::string& world_path,
                 const cmn::CoarseMap& world, const cmn::Drawing& drawing, std::uint32_t seed) {
  const cmn::CoarseMap map = cmn::largest_region(drawing.map()).map;
  std::mt19937_64 rng{seed};
  const auto route = cmn::RouteSampler{cmn::World{world}, world, kGoalClearance}.sample(
      0.0, 1e3, [&](cmn::Point2 p) { return map.is_free(map.cell_of(drawing.world_to_map(p))); },
      rng);
  if (!route) {
    throw std::runtime_error("no place of " + world_path + " would do as a goal on this drawing");
  }
  std::ofstream out{path, std::ios::app};
  out << std::setprecision(9) << "\n# For scoring and pictures; no robot reads it.\nworld: "
      << std::filesystem::proximate(world_path, std::filesystem::absolute(path).parent_path())
             .string()
      << "\ndefault_goal: goal\n";
  print_places(out, world, drawing);
  print_place(out, "goal", route->goal_world, drawing);
  require_written(out, path);
}

int run(int argc, char** argv) {
  po::options_description options{
      "cmn_coarsen WORLD.yaml --mpp 0.4 --out X.yaml\n\n"
      "Makes the map for a robot from a metric one (map_server format; unknown counts as\n"
      "occupied) and writes X.yaml and X.png:\n"
      "  --kind grid        a cell is occupied when more than half of it is\n"
      "  --kind walls       the same without the free-standing furniture\n"
      "  --kind hand_drawn  as a person might draw it: out of proportion, turned, in an unknown\n"
      "                     scale; also writes X_places.yaml, which says what lies where\n"
      "Options"};
  options.add_options()("help", "print this")("world", po::value<std::string>(), "the metric map")(
      "kind", po::value<std::string>()->default_value("grid"), "grid, walls or hand_drawn")(
      "mpp", po::value<double>()->default_value(0.4), "metres per pixel (cell) of the coarse map")(
      "clearance", po::value<double>()->default_value(0.0),
      "of grid and walls: ground counts as occupied this near to anything [m], as in CMN's maps")(
      "turn", po::value<double>()->default_value(0.0),
      "of grid and walls: how far the sheet is turned to the left against the world's axes [deg]")(
      "seed", po::value<std::uint32_t>()->default_value(1), "which of all drawings, and the goal")(
      "goal", "write into X.yaml itself what lies where, and a default_goal: for scripts/demo")(
      "out", po::value<std::string>(), "the map to write, .yaml");
  po::variables_map given;
  po::store(po::command_line_parser(argc, argv)
                .options(options)
                .positional(po::positional_options_description{}.add("world", 1))
                .run(),
            given);
  if (given.count("help") != 0 || argc == 1) {
    std::cout << options;
    return argc == 1 ? EXIT_FAILURE : EXIT_SUCCESS;
  }
  if (given.count("world") == 0 || given.count("out") == 0) {
    throw std::runtime_error("WORLD.yaml and --out X.yaml are needed; --help explains");
  }
  const auto mpp = given["mpp"].as<double>();
  const auto clearance = given["clearance"].as<double>();
  const double turn_rad = given["turn"].as<double>() * cmn::kPi / 180.0;
  if (!std::isfinite(turn_rad)) {
    throw std::runtime_error("--turn is no number of degrees");
  }
  const auto seed = given["seed"].as<std::uint32_t>();
  using Draw = std::function<cmn::Drawing(const cmn::CoarseMap&)>;
  const std::map<std::string, Draw> kinds{
      {"grid",
       [&](const cmn::CoarseMap& world) {
         return cmn::coarse_grid(cmn::turned_map(world, turn_rad), mpp, clearance);
       }},
      {"walls",
       [&](const cmn::CoarseMap& world) {
         return cmn::coarse_grid(cmn::turned_map(cmn::without_furniture(world), turn_rad), mpp,
                                 clearance);
       }},
      {"hand_drawn",
       [&](const cmn::CoarseMap& world) { return cmn::hand_drawn(world, mpp, seed); }}};
  const auto kind = kinds.find(given["kind"].as<std::string>());
  if (kind == kinds.end()) {
    throw std::runtime_error("--kind " + given["kind"].as<std::string>() +
                             " is unknown; there are grid, walls and hand_drawn");
  }

  if (kind->first == "hand_drawn" && turn_rad != 0.0) {
    throw std::runtime_error("--turn is for grid and walls: a hand drawing has turns of its own");
  }

  const std::string world_path = given["world"].as<std::string>();
  const cmn::CoarseMap world = cmn::read_map(world_path);
  const cmn::Drawing drawing = kind->second(world);
  const cmn::CoarseMap& coarse = drawing.map();
  if (coarse.free_count() == 0) {
    throw std::runtime_error("no cell is left free at " + std::to_string(coarse.resolution()) +
                             " m per cell: take a smaller --mpp");
  }
  const std::string out = given["out"].as<std::string>();
  cmn::write_map(out, coarse);
  std::cout << out << ": " << coarse.width() << " x " << coarse.height() << " cells of "
            << coarse.resolution() << " m, " << coarse.free_count() << " free\n";
  if (given.count("goal") != 0) {
    append_goal(out, world_path, world, drawing, seed);
  } else if (kind->first == "hand_drawn") {
    write_places(out.substr(0, out.rfind('.')) + "_places.yaml", world_path, world, drawing);
  }
  if (kind->first == "hand_drawn") {
    std::cout << "drawn at " << drawing.scale() << " of the nominal scale, turned by "
              << drawing.quarter_turns() << " quarter turns to the left\n";
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) { return cmn::tool_main(argc, argv, run); }
