// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmn_house: a furnished home from a seed, as a world to drive in and as a picture.

#include "coarse_map_nav/evaluation/house_generator.hpp"
#include "coarse_map_nav/evaluation/house_picture.hpp"
#include "coarse_map_nav/mapping/map_writer.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tool_main.hpp"
#include <boost/program_options.hpp>
#include <opencv2/imgcodecs.hpp>

namespace {

namespace po = boost::program_options;

void write_picture(const std::string& path, const cv::Mat& picture) {
  bool is_written = false;
  try {
    is_written = cv::imwrite(path, picture, {cv::IMWRITE_PNG_COMPRESSION, 9});
  } catch (const cv::Exception&) {
    is_written = false;
  }
  if (!is_written) {
    throw std::runtime_error(path + ": cannot be written; does the folder exist?");
  }
  std::cout << path << "\n";
}

std::string title_of(std::uint32_t seed, const cmn::House& house) {
  return "house " + std::to_string(seed) + ": " + std::to_string(std::lround(house.area_m2())) +
         " m2";
}

int run(int argc, char** argv) {
  po::options_description options{
      "cmn_house --seed 3 --out DIR\n"
      "cmn_house --seed 1 --sheet 24 --out DIR\n\n"
      "Draws a furnished home of 40 to 150 m2 and writes house_3.yaml and .png (map_server\n"
      "format: what a LiDAR sees 0.2 m above the floor), house_3_walls.yaml and .png (its floor\n"
      "plan) and house_3_picture.png; or one picture of many homes, houses.png.\n"
      "Options"};
  options.add_options()("help", "print this")("seed", po::value<std::uint32_t>()->default_value(1),
                                              "which house; with --sheet, the first of them")(
      "out", po::value<std::string>(), "the folder to write to")(
      "resolution", po::value<double>()->default_value(0.05), "of the maps [m]")(
      "sheet", po::value<int>(), "how many houses on one picture")(
      "smallest", po::value<double>()->default_value(cmn::HouseParams{}.smallest_m2),
      "floor area [m2]")("largest",
                         po::value<double>()->default_value(cmn::HouseParams{}.largest_m2),
                         "floor area [m2]");
  po::variables_map given;
  po::store(po::parse_command_line(argc, argv, options), given);
  if (given.count("help") != 0 || argc == 1) {
    std::cout << options;
    return argc == 1 ? EXIT_FAILURE : EXIT_SUCCESS;
  }
  if (given.count("out") == 0) {
    throw std::runtime_error("--out DIR is needed; --help explains");
  }
  const std::string folder = given["out"].as<std::string>();
  const auto seed = given["seed"].as<std::uint32_t>();
  cmn::HouseParams params;
  params.smallest_m2 = given["smallest"].as<double>();
  params.largest_m2 = given["largest"].as<double>();
  if (given.count("sheet") != 0) {
    const int count = given["sheet"].as<int>();
    if (count < 1 || count > 1000) {
      throw std::runtime_error("--sheet takes a number from 1 to 1000");
    }
    std::vector<cmn::House> houses;
    std::vector<std::string> titles;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
      houses.push_back(cmn::generate_house(seed + i, params));
      titles.push_back(title_of(seed + i, houses.back()));
    }
    write_picture(folder + "/houses.png", cmn::house_sheet(houses, titles));
    return EXIT_SUCCESS;
  }
  const cmn::House house = cmn::generate_house(seed, params);
  const std::string stem = folder + "/house_" + std::to_string(seed);
  const auto resolution = given["resolution"].as<double>();
  cmn::write_map(stem + ".yaml", cmn::occupancy(house, resolution));
  cmn::write_map(stem + "_walls.yaml", cmn::walls(house, resolution));
  std::cout << title_of(seed, house) << ", " << house.rooms.size() << " rooms, "
            << house.furniture.size() << " pieces of furniture\n"
            << stem << ".yaml\n"
            << stem << "_walls.yaml\n";
  write_picture(stem + "_picture.png", cmn::house_picture(house));
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) { return cmn::tool_main(argc, argv, run); }
