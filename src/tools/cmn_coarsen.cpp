// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmn_coarsen: a metric map -> the coarse grid that a robot is given.

#include "coarse_map_nav/mapping/downsample.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/mapping/map_writer.hpp"

#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

#include <boost/program_options.hpp>

namespace {

namespace po = boost::program_options;

int run(int argc, char** argv) {
  po::options_description options{
      "cmn_coarsen WORLD.yaml --mpp 0.4 --out X.yaml\n\n"
      "Makes a metric map (map_server format) coarse: a cell is occupied when more than half of "
      "it\n"
      "is. Unknown counts as occupied. Writes X.yaml and X.png at the same place in the map "
      "frame.\n"
      "Options"};
  options.add_options()("help", "print this")("world", po::value<std::string>(), "the metric map")(
      "mpp", po::value<double>()->default_value(0.4), "metres per pixel (cell) of the coarse map")(
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
  const cmn::CoarseMap world = cmn::read_map(given["world"].as<std::string>());
  const cmn::CoarseMap coarse = cmn::downsampled(world, given["mpp"].as<double>());
  if (coarse.free_count() == 0) {
    throw std::runtime_error("no cell is left free at " + std::to_string(coarse.resolution()) +
                             " m per cell: take a smaller --mpp");
  }
  const std::string out = given["out"].as<std::string>();
  cmn::write_map(out, coarse);
  std::cout << out << ": " << coarse.width() << " x " << coarse.height() << " cells of "
            << coarse.resolution() << " m, " << coarse.free_count() << " free\n";
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& e) {
    std::cerr << "cmn_coarsen: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
}
