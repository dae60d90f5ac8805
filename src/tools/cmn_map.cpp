// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// cmn_map: any readable map or drawing -> a coarse map in map_server's format.
#include "coarse_map_nav/mapping/coarsen.hpp"
#include "coarse_map_nav/mapping/contact_sheet.hpp"
#include "coarse_map_nav/mapping/image_reader.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/mapping/map_writer.hpp"
#include "coarse_map_nav/mapping/sketch.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>

#include "tool_main.hpp"
#include <boost/program_options.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace {

namespace po = boost::program_options;

bool ends_with(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

void write_picture(const std::string& path, const cv::Mat& picture) {
  if (!cv::imwrite(path, picture)) {
    throw std::runtime_error(path + ": cannot be written");
  }
  std::cout << "wrote " << path << "\n";
}

void write_stages(const std::string& folder, const cmn::Sketch& sketch) {
  std::filesystem::create_directories(folder);
  for (const cmn::SketchStage& stage : sketch.stages) {
    write_picture(folder + "/" + stage.name + ".png", stage.picture);
  }
  write_picture(folder + "/stages.png", cmn::contact_sheet(sketch.stages));
}

void describe(const cmn::CoarseMap& map) {
  const cv::Mat occupied = cmn::image_of(map.occupied());
  cv::Mat labels;
  const int rooms = cv::connectedComponents(255 - occupied, labels, 4) - 1;
  cv::Mat framed;  // all that lies outside is occupied
  cv::copyMakeBorder(occupied, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, 255);
  const int islands = cv::connectedComponents(framed, labels, 8) - 2;
  std::cout << map.width() << " x " << map.height() << " cells of " << map.resolution()
            << " m, free "
            << 100 * map.free_count() / std::max<std::size_t>(1, map.occupied().size())
            << " %, connected free areas " << rooms << ", free-standing obstacles " << islands
            << "\n";
}

/// A grid that has cells already: only their number changes.
cmn::CoarseMap convert_grid(const std::string& input, const po::variables_map& options) {
  const double resolution = options.count("resolution") ? options["resolution"].as<double>() : 0.4;
  cmn::CoarseMap map = cmn::read_map(input, resolution);
  if (options.count("cells")) {
    const int cells = options["cells"].as<int>();
    if (cells > map.width()) {
      throw std::runtime_error(input + ": has " + std::to_string(map.width()) +
                               " cells across; it can be reduced, not refined to " +
                               std::to_string(cells));
    }
    map = cmn::coarsen(map, cells);
  }
  if (options.count("resolution")) {
    map = {map.occupied(), resolution, map.T_map_grid()};
  }
  return map;
}

cmn::CoarseMap convert_drawing(const std::string& input, const po::variables_map& options,
                               cmn::SketchParams params) {
  const double resolution = options.count("resolution") ? options["resolution"].as<double>() : 0.4;
  if (options.count("cells")) {
    params.cells = options["cells"].as<int>();
  }
  cmn::Sketch sketch;
  const cv::Mat picture = cmn::read_colour_image(input);
  try {
    sketch = cmn::read_sketch(picture, params);
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(input + ": " + e.what());
  }
  if (options.count("stages")) {
    write_stages(options["stages"].as<std::string>(), sketch);
  }
  return {sketch.occupied, resolution};
}

void convert(const po::variables_map& options, const cmn::SketchParams& params) {
  const std::string input = options["input"].as<std::string>();
  if (options.count("cells") && options["cells"].as<int>() < 2) {
    throw std::runtime_error("--cells must be at least 2");
  }
  if (options.count("resolution") && !(options["resolution"].as<double>() > 0.0)) {
    throw std::runtime_error("--resolution must be above 0 m/cell");
  }
  if (!(params.threshold >= 0.0 && params.threshold < 1.0)) {
    throw std::runtime_error("--threshold must lie in [0, 1)");
  }
  const bool is_grid =
      ends_with(input, ".yaml") || ends_with(input, ".yml") || ends_with(input, ".npy");
  if (is_grid && options.count("stages")) {
    throw std::runtime_error("--stages is for photos and drawings; " + input + " is a grid");
  }
  const cmn::CoarseMap map =
      is_grid ? convert_grid(input, options) : convert_drawing(input, options, params);
  std::string out = options["out"].as<std::string>();
  out += ends_with(out, ".yaml") ? "" : ".yaml";
  std::filesystem::create_directories(std::filesystem::absolute(out).parent_path());
  cmn::write_map(out, map);
  describe(map);
  std::cout << "wrote " << out << "\n";
}

int run(int argc, char** argv) {
  cmn::SketchParams params;
  po::options_description shown{
      "cmn_map INPUT: makes a coarse map of a photo, a drawing, a map_server yaml or a .npy "
      "grid"};
  shown.add_options()("help,h", "this text")(
      "cells", po::value<int>(), "width of the map in cells; drawings: 50, grids: as they are")(
      "resolution", po::value<double>(), "[m/cell] nominal; drawings and .npy: 0.4")(
      "out", po::value<std::string>()->default_value("map"), "writes this .yaml and .png")(
      "stages", po::value<std::string>(), "folder for a picture of every step, and stages.png")(
      "threshold", po::value<double>(&params.threshold)->default_value(0.0),
      "darker than this share of the paper is ink; 0: found automatically");
  po::options_description all;
  all.add(shown).add_options()("input", po::value<std::string>());
  po::positional_options_description positional;
  positional.add("input", 1);
  po::variables_map options;
  po::store(po::command_line_parser(argc, argv).options(all).positional(positional).run(), options);
  po::notify(options);
  if (options.count("help")) {
    std::cout << shown;
    return EXIT_SUCCESS;
  }
  if (!options.count("input")) {
    throw std::runtime_error("no input is given; see cmn_map --help");
  }
  convert(options, params);
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) { return cmn::tool_main(argc, argv, run); }
