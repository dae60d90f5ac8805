// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/map_writer.hpp"

#include "coarse_map_nav/mapping/image_reader.hpp"

#include <fstream>
#include <iomanip>
#include <limits>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

namespace cmn {

void write_map(const std::string& yaml_path, const CoarseMap& map) {
  const std::string ending = ".yaml";
  if (yaml_path.size() <= ending.size() ||
      yaml_path.compare(yaml_path.size() - ending.size(), ending.size(), ending) != 0) {
    throw std::runtime_error(yaml_path + ": a map is written to a name that ends in .yaml");
  }
  const std::string png_path = yaml_path.substr(0, yaml_path.size() - ending.size()) + ".png";
  bool written = false;
  try {
    written = map.width() > 0 && cv::imwrite(png_path, 255 - image_of(map.occupied()));
  } catch (const cv::Exception&) {
    written = false;
  }
  if (!written) {
    throw std::runtime_error(png_path + ": cannot be written; does the folder exist?");
  }
  std::ofstream yaml{yaml_path};
  const Pose2& origin = map.T_map_grid();
  yaml << std::setprecision(std::numeric_limits<double>::max_digits10)
       << "image: " << png_path.substr(png_path.find_last_of('/') + 1) << "\n"
       << "resolution: " << map.resolution() << "\n"
       << "origin: [" << origin.x << ", " << origin.y << ", " << origin.yaw << "]\n"
       << "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  if (!yaml.flush()) {
    throw std::runtime_error(yaml_path + ": cannot be written; does the folder exist?");
  }
}

}  // namespace cmn
