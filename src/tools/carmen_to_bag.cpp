// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// carmen_to_bag: a recorded LiDAR log (CARMEN format) -> a rosbag for playback.launch.

#include "coarse_map_nav/ros/carmen_bag.hpp"

#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "carmen_options.hpp"
#include "tool_main.hpp"
#include <boost/program_options.hpp>

namespace {

namespace po = boost::program_options;
constexpr double kRadPerDeg = cmn::kPi / 180.0;

void report(const cmn::CarmenBagSummary& bag, const std::string& path) {
  std::cout << path << ": " << bag.scans << " scans, " << bag.poses << " poses, " << bag.duration_s
            << " s, " << bag.path_m << " m driven; odometry ends "
            << cmn::norm(bag.drift.position()) << " m and " << bag.drift.yaw / kRadPerDeg
            << " deg off the truth\n";
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
      "noise", po::value<std::vector<std::string>>()->multitoken(), cmn::noise_help({}).c_str());
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
    bag.noise = cmn::noise_of(given["noise"].as<std::vector<std::string>>(), {});
  }
  if (given.count("to-world") != 0 && given.count("world-pose") != 0) {
    throw std::runtime_error("--to-world and --world-pose exclude each other");
  }
  if (given.count("to-world") != 0) {
    bag.T_world_log =
        cmn::world_pose_of(given["to-world"].as<std::string>(),
                           given.count("building") != 0 ? given["building"].as<std::string>()
                                                        : cmn::building_of_log(path));
  } else if (given.count("world-pose") != 0) {
    const auto pose = given["world-pose"].as<std::vector<double>>();
    if (pose.size() != 3) {
      throw std::runtime_error("--world-pose takes three numbers: YAW_DEG X Y");
    }
    bag.T_world_log = {pose[1], pose[2], pose[0] * kRadPerDeg};
  }
  const cmn::CarmenLog log = cmn::read_carmen_log(path);
  cmn::report_faults(log);
  const std::string out = given["out"].as<std::string>();
  report(cmn::write_carmen_bag(log, bag, out), out);
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) { return cmn::tool_main(argc, argv, run); }
