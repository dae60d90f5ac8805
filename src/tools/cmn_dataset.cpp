// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmn_dataset: renders what the network that sees local occupancy learns from.

#include "coarse_map_nav/evaluation/house_generator.hpp"
#include "coarse_map_nav/evaluation/progress.hpp"
#include "coarse_map_nav/learning/example_renderer.hpp"
#include "coarse_map_nav/learning/example_set.hpp"
#include "coarse_map_nav/learning/example_sheet.hpp"
#include "coarse_map_nav/learning/prediction_score.hpp"
#include "coarse_map_nav/scene/furniture_meshes.hpp"
#include "coarse_map_nav/scene/house_scene.hpp"
#include "coarse_map_nav/scene/sdf_reader.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "needed_options.hpp"
#include "tool_main.hpp"
#include <boost/program_options.hpp>
#include <opencv2/imgcodecs.hpp>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
namespace po = boost::program_options;

std::atomic<bool> is_interrupted{false};
void interrupt(int signal) {
  is_interrupted = true;
  std::signal(signal, SIG_DFL);  // a second one kills
}

struct Plan {
  std::string out;
  std::uint32_t first_house = 0;
  std::size_t houses = 0;
  std::size_t views = 0;
  std::uint64_t seed = 1;
  int jobs = 1;
  cmn::ExampleParams params;
};

cmn::ExampleRenderer renderer_of(cmn::MeshScene scene, const Plan& plan, std::uint32_t house) {
  return {std::move(scene), plan.params, plan.seed * 0x100000000U + house};
}

std::vector<cmn::Example> examples_of(cmn::MeshScene scene, const Plan& plan, std::uint32_t house) {
  cmn::ExampleRenderer renderer = renderer_of(std::move(scene), plan, house);
  std::vector<cmn::Example> examples;
  for (std::size_t i = 0; i < plan.views && !is_interrupted; ++i) {
    examples.push_back(renderer.next());
  }
  return examples;
}

std::string file_of(const Plan& plan, std::uint32_t house) {
  return plan.out + "/house_" + std::to_string(house) + ".h5";
}

/// Renders the houses that are not there yet, several at a time.
class Renderer {
 public:
  explicit Renderer(const Plan& plan) : plan_{plan} {
    for (std::size_t i = 0; i < plan.houses; ++i) {
      const auto house = static_cast<std::uint32_t>(plan.first_house + i);
      if (!fs::exists(file_of(plan, house))) {
        todo_.push_back(house);
      }
    }
    progress_.total = plan.houses * plan.views;
    progress_.done_before = progress_.done = (plan.houses - todo_.size()) * plan.views;
  }

  void run() {
    std::vector<std::thread> threads;
    for (int i = 0; i < plan_.jobs; ++i) {
      threads.emplace_back([this] { work(); });
    }
    for (std::thread& thread : threads) {
      thread.join();
    }
    if (!error_.empty()) {
      throw std::runtime_error(error_);
    }
    std::printf("%zu examples of %zu houses in %s, %.1f/s\n", progress_.done,
                progress_.done / plan_.views, plan_.out.c_str(),
                static_cast<double>(progress_.done - progress_.done_before) / elapsed_s());
  }

 private:
  void work() {
    try {
      const auto meshes = cmn::open_furniture();
      for (std::size_t i = next_++; i < todo_.size() && !is_interrupted; i = next_++) {
        const std::uint32_t house = todo_[i];
        const std::vector<cmn::Example> examples = examples_of(
            cmn::house_scene(cmn::generate_house(house), house, meshes.get()), plan_, house);
        const std::lock_guard<std::mutex> lock{mutex_};
        if (!is_interrupted) {
          cmn::write_examples(file_of(plan_, house), house, examples);
          progress_.done += examples.size();
          tell();
        }
      }
    } catch (const std::exception& e) {
      const std::lock_guard<std::mutex> lock{mutex_};
      error_ = e.what();
      next_ = todo_.size();
    }
  }
  double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  void tell() {
    if (isatty(STDERR_FILENO) != 0) {
      progress_.elapsed_s = elapsed_s();
      std::fprintf(stderr, "\r\033[K%s%s", cmn::progress_line(progress_).c_str(),
                   progress_.done == progress_.total ? "\n" : "");
    }
  }

  Plan plan_;
  std::vector<std::uint32_t> todo_;
  std::atomic<std::size_t> next_{0};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;  ///< of what follows, and of HDF5
  cmn::Progress progress_;
  std::string error_;
};

cmn::MeshScene read_world(const std::string& path) {
  std::vector<std::string> warnings;
  cmn::MeshScene scene = cmn::read_sdf(path, warnings);
  for (const std::string& warning : warnings) {
    std::cerr << warning << "\n";
  }
  return scene;
}

/// A world that is not generated is for tests alone.
void render_world(const Plan& plan, const std::string& path) {
  const std::string file = plan.out + "/" + fs::path{path}.stem().string() + ".h5";
  cmn::write_examples(file, cmn::kForeignWorld,
                      examples_of(read_world(path), plan, cmn::kForeignWorld));
  std::cout << file << "\n";
}

/// Renders the test split's examples, as they are in their files, and measures depth on them.
class DepthMeasurement {
 public:
  void add(cmn::MeshScene scene, const Plan& plan, std::uint32_t house) {
    cmn::ExampleRenderer renderer = renderer_of(std::move(scene), plan, house);
    for (std::size_t i = 0; i < plan.views && !is_interrupted; ++i) {
      const cmn::Example example = renderer.next();
      const cmn::PredictedOccupancy seen = renderer.last_by_depth();
      near_.add(seen.near, example.near);
      wide_.add(*seen.wide, example.wide);
      ++examples_;
    }
  }
  void add_houses(const Plan& plan) {
    const auto meshes = cmn::open_furniture();
    for (std::size_t i = 0; i < plan.houses; ++i) {
      const auto house = static_cast<std::uint32_t>(plan.first_house + i);
      if (cmn::split_of(house) == cmn::Split::kTest) {
        add(cmn::house_scene(cmn::generate_house(house), house, meshes.get()), plan, house);
      }
    }
  }
  void print() const {
    std::printf("%zu panoramas\nRESULT square=near %s\nRESULT square=wide %s\n", examples_,
                cmn::score_text(near_).c_str(), cmn::score_text(wide_).c_str());
  }

 private:
  cmn::SquareScore near_;
  cmn::SquareScore wide_;
  std::size_t examples_ = 0;
};

void write_sheet(const std::string& folder, const std::string& split, std::uint64_t seed,
                 const std::string& path) {
  constexpr std::size_t kRows = 16;
  cmn::ExampleSet examples{folder, cmn::parse_split(split)};
  std::vector<std::size_t> order = cmn::shuffled_order(examples.size(), seed, 0);
  order.resize(std::min(order.size(), kRows));
  std::vector<cmn::SheetRow> rows;
  for (const std::size_t index : order) {
    const cmn::Example example = examples.read(index);
    rows.push_back({example.panorama, example, std::nullopt});
  }
  if (!cv::imwrite(path, cmn::example_sheet(rows))) {
    throw std::runtime_error(path + ": cannot be written");
  }
}

int run(int argc, char** argv) {
  po::options_description options{
      "cmn_dataset --out DIR [--houses 600] [--views 32] [--jobs 2]\n"
      "cmn_dataset --out DIR --world small_house.world --views 500\n"
      "cmn_dataset --out DIR --sheet samples.png\n"
      "cmn_dataset --measure-depth [--world small_house.world]\n\n"
      "Renders panoramas in generated, furnished homes and the occupancy around the robot, a file\n"
      "a house. What is there already is kept: the same command goes on. Houses are trained on,\n"
      "validated on or tested on by their seed; worlds are for tests alone.\n"
      "docs/parameters.md lists what may stand in the file of parameters.\n"
      "Options"};
  auto add_option = options.add_options();
  add_option("help", "print this");
  add_option("out", po::value<std::string>(), "folder of the examples");
  add_option("houses", po::value<std::size_t>()->default_value(600), "how many");
  add_option("first-house", po::value<std::uint32_t>()->default_value(1000000),
             "seed of the first; those of the evaluation are far lower");
  add_option("views", po::value<std::size_t>()->default_value(32), "panoramas in each");
  add_option("seed", po::value<std::uint64_t>()->default_value(1), "of places, cameras and lights");
  add_option("jobs", po::value<int>()->default_value(1), "threads; the result is the same for any");
  add_option("params", po::value<std::string>(), "YAML file of parameters");
  add_option("world", po::value<std::string>(), "a Gazebo world instead of houses");
  add_option("measure-depth",
             "write nothing; measure a depth camera's projection on the examples "
             "of the test split");
  add_option("sheet", po::value<std::string>(), "draw some of the examples that are there");
  add_option("split", po::value<std::string>()->default_value("train"),
             "with --sheet: train, validation or test");
  po::variables_map given;
  po::store(po::parse_command_line(argc, argv, options), given);
  if (given.count("help") != 0 || argc == 1) {
    std::cout << options;
    return argc == 1 ? EXIT_FAILURE : EXIT_SUCCESS;
  }
  Plan plan;
  plan.first_house = given["first-house"].as<std::uint32_t>();
  plan.houses = given["houses"].as<std::size_t>();
  plan.views = given["views"].as<std::size_t>();
  plan.seed = given["seed"].as<std::uint64_t>();
  plan.jobs = given["jobs"].as<int>();
  plan.params = cmn::params_of<cmn::ExampleParams>(given);
  if (plan.jobs < 1 || plan.views < 1 || plan.houses < 1) {
    throw std::runtime_error("--jobs, --views and --houses are 1 or more");
  }
  if (given.count("measure-depth") != 0) {
    DepthMeasurement depth;
    if (given.count("world") != 0) {
      depth.add(read_world(given["world"].as<std::string>()), plan, cmn::kForeignWorld);
    } else {
      depth.add_houses(plan);
    }
    depth.print();
    return EXIT_SUCCESS;
  }
  plan.out = cmn::needed(given, "out");
  if (given.count("sheet") != 0) {
    write_sheet(plan.out, given["split"].as<std::string>(), plan.seed,
                given["sheet"].as<std::string>());
    return EXIT_SUCCESS;
  }
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  fs::create_directories(plan.out);
  if (given.count("world") != 0) {
    render_world(plan, given["world"].as<std::string>());
  } else {
    Renderer{plan}.run();
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) { return cmn::tool_main(argc, argv, run); }
