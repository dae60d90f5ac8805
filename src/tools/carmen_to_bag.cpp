// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// carmen_to_bag: a recorded LiDAR log (CARMEN format) -> a rosbag for playback.launch.

#include "coarse_map_nav/ros/carmen_bag.hpp"

#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tool_main.hpp"
#include <boost/program_options.hpp>
#include <yaml-cpp/yaml.h>

namespace {

namespace po = boost::program_options;
constexpr double kRadPerDeg = cmn::kPi / 180.0;
constexpr std::size_t kMalformedShown = 5;

/// "radish/intel.log.gz" -> "intel".
std::string building_of(const std::string& path) {
  const std::string name = path.substr(path.find_last_of('/') + 1);
  return name.substr(0, name.find(".log"));
}

/// The line of a building in a file of `NAME: {yaw_deg: .., x: .., y: ..}`.
cmn::Pose2 world_pose_of(const std::string& path, const std::string& building) {
  try {
    const YAML::Node all = YAML::LoadFile(path);
    const YAML::Node one = all[building];
    if (!one) {
      std::string known;
      for (const auto& entry : all) {
        known += (known.empty() ? "" : ", ") + entry.first.as<std::string>();
      }
      throw std::runtime_error("no building \"" + building + "\" (it has " + known +
                               "); name one with --building");
    }
    return {one["x"].as<double>(), one["y"].as<double>(), one["yaw_deg"].as<double>() * kRadPerDeg};
  } catch (const std::exception& e) {
    throw std::runtime_error(path + ": " + e.what());
  }
}

cmn::OdometryNoiseParams noise_of(const std::vector<std::string>& settings) {
  if (settings == std::vector<std::string>{"off"}) {
    return {0.0, 0.0, 0.0, 0.0, 0.0};
  }
  cmn::ParamTree tree;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    const std::string value = equals == std::string::npos ? "" : setting.substr(equals + 1);
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    if (value.empty() || *end != '\0') {
      throw std::runtime_error("--noise " + setting + ": expected off or name=number");
    }
    tree[setting.substr(0, equals)] = number;
  }
  cmn::OdometryNoiseParams noise;
  std::string message;
  for (const std::string& problem : cmn::load_params(tree, noise)) {
    message += (message.empty() ? "--noise " : "\n--noise ") + problem;
  }
  if (!message.empty()) {
    throw std::runtime_error(message);
  }
  return noise;
}

void report(const cmn::CarmenLog& log) {
  if (!log.malformed.empty()) {
    std::cerr << log.malformed.size() << " malformed lines skipped:\n";
    for (std::size_t i = 0; i < std::min(kMalformedShown, log.malformed.size()); ++i) {
      std::cerr << "  line " << log.malformed[i].line << ": " << log.malformed[i].text << "\n";
    }
  }
  if (!log.has_clock) {
    std::cerr << "The log's stamps are too coarse to order its lines: 10 lines a second assumed.\n";
  } else if (log.moved_stamps > 0) {
    std::cerr << log.moved_stamps << " stamps out of order: spread between their neighbours.\n";
  }
}

void report(const cmn::CarmenBagSummary& bag, const std::string& path) {
  std::cout << path << ": " << bag.scans << " scans, " << bag.poses << " poses, " << bag.duration_s
            << " s, " << bag.path_m << " m driven; odometry ends "
            << cmn::norm(bag.drift.position()) << " m and " << bag.drift.yaw / kRadPerDeg
            << " deg off the truth\n";
}

std::string noise_help() {
  std::string text = "off, or any of";
  for (const cmn::ParamDoc& doc : cmn::list_params(cmn::OdometryNoiseParams{})) {
    text += "\n  " + doc.path + "=" + doc.default_value + "  " + doc.text;
  }
  return text;
}

int run(int argc, char** argv) {
  po::options_description options{
      "carmen_to_bag LOG --out X.bag [options]\n\n"
      "Turns a recorded LiDAR log (CARMEN: FLASER and ODOM lines; plain or .gz) into a rosbag "
      "with\n"
      "scan, odom, ground_truth, /tf and /tf_static. The poses of the log are taken for the "
      "truth,\n"
      "odometry is made of them with seeded drift. Options"};
  options.add_options()("help", "print this")("log", po::value<std::string>(), "the log")(
      "out", po::value<std::string>(), "the bag to write")(
      "to-world", po::value<std::string>(),
      "YAML file with a line for each building that takes its log into the world map")(
      "building", po::value<std::string>(), "the line to take; else from the name of the log")(
      "world-pose", po::value<std::vector<double>>()->multitoken(),
      "YAW_DEG X Y: the same, given here. Without either, the log's axes are taken for those of "
      "the "
      "building: the filter needs headings along the main walls")(
      "seed", po::value<std::uint32_t>()->default_value(1), "of the odometry's drift")(
      "noise", po::value<std::vector<std::string>>()->multitoken(), noise_help().c_str());
  po::variables_map given;
  // Without short options a negative number is a value.
  po::store(po::command_line_parser(argc, argv)
                .options(options)
                .positional(po::positional_options_description{}.add("log", 1))
                .style(po::command_line_style::unix_style ^ po::command_line_style::allow_short)
                .run(),
            given);
  if (given.count("help") != 0 || argc == 1) {
    std::cout << options;
    return argc == 1 ? EXIT_FAILURE : EXIT_SUCCESS;
  }
  if (given.count("log") == 0 || given.count("out") == 0) {
    throw std::runtime_error("LOG and --out X.bag are needed; --help explains");
  }
  const std::string path = given["log"].as<std::string>();
  cmn::CarmenBagOptions bag;
  bag.seed = given["seed"].as<std::uint32_t>();
  if (given.count("noise") != 0) {
    bag.noise = noise_of(given["noise"].as<std::vector<std::string>>());
  }
  if (given.count("to-world") != 0 && given.count("world-pose") != 0) {
    throw std::runtime_error("--to-world and --world-pose exclude each other");
  }
  if (given.count("to-world") != 0) {
    bag.T_world_log = world_pose_of(
        given["to-world"].as<std::string>(),
        given.count("building") != 0 ? given["building"].as<std::string>() : building_of(path));
  } else if (given.count("world-pose") != 0) {
    const auto pose = given["world-pose"].as<std::vector<double>>();
    if (pose.size() != 3) {
      throw std::runtime_error("--world-pose takes three numbers: YAW_DEG X Y");
    }
    bag.T_world_log = {pose[1], pose[2], pose[0] * kRadPerDeg};
  }
  const cmn::CarmenLog log = cmn::read_carmen_log(path);
  report(log);
  const std::string out = given["out"].as<std::string>();
  report(cmn::write_carmen_bag(log, bag, out), out);
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) { return cmn::tool_main(argc, argv, run); }
