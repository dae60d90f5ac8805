// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/map_reader.hpp"

#include "coarse_map_nav/mapping/image_reader.hpp"
#include "coarse_map_nav/mapping/npy_reader.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace cmn {
namespace {

enum class Mode { kTrinary, kScale, kRaw };

/// The keys of map_server, http://wiki.ros.org/map_server, "Map format".
struct MapServerKeys {
  std::string image;
  double resolution = 0.0;
  Pose2 T_map_grid;
  bool negate = false;
  double occupied_thresh = 0.0;
  double free_thresh = 0.0;
  Mode mode = Mode::kTrinary;
};

std::string ending_of(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  std::string ending = dot == std::string::npos || path[dot] == '/' ? "" : path.substr(dot);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// Takes keys out of a map_server file and collects all that is wrong with them.
class KeyReader {
 public:
  explicit KeyReader(const YAML::Node& root) : root_{root} {}

  MapServerKeys read() {
    MapServerKeys keys;
    keys.image = text("image");
    keys.resolution = number("resolution");
    if (!(keys.resolution > 0.0)) {
      complain("resolution", "must be above 0 m/cell");
    }
    keys.T_map_grid = origin();
    keys.negate = truth("negate");
    keys.occupied_thresh = share("occupied_thresh");
    keys.free_thresh = share("free_thresh");
    if (problems_.empty() && keys.free_thresh > keys.occupied_thresh) {
      complain("free_thresh", "must not be above occupied_thresh");
    }
    if (root_["mode"]) {
      keys.mode = mode();
    }
    return keys;
  }
  const std::string& problems() const { return problems_; }

 private:
  void complain(const std::string& key, const std::string& problem) {
    if (faulty_ != key) {  // one complaint a key
      problems_ += (problems_.empty() ? "" : "; ") + key + " " + problem;
      faulty_ = key;
    }
  }
  template <class T>
  T value(const std::string& key, const std::string& expected, T otherwise) {
    T result{};
    if (!root_[key]) {
      complain(key, "is missing");
    } else if (YAML::convert<T>::decode(root_[key], result)) {
      return result;
    } else {
      complain(key, "must be " + expected);
    }
    return otherwise;
  }
  std::string text(const std::string& key) {
    const std::string word = value<std::string>(key, "a file name", "");
    if (word.empty()) {
      complain(key, "must be a file name");
    }
    return word;
  }
  double number(const std::string& key) {
    const double x = value<double>(key, "a number", 1.0);
    if (!std::isfinite(x)) {
      complain(key, "must be a finite number");
    }
    return x;
  }
  double share(const std::string& key) {
    const double x = number(key);
    if (!(x >= 0.0 && x <= 1.0)) {
      complain(key, "must lie in [0, 1]");
    }
    return x;
  }
  bool truth(const std::string& key) {
    int flag = 0;
    if (root_[key] && YAML::convert<int>::decode(root_[key], flag) && (flag == 0 || flag == 1)) {
      return flag == 1;
    }
    return value<bool>(key, "0 or 1", false);
  }
  Pose2 origin() {
    const YAML::Node node = root_["origin"];
    std::array<double, 3> x{};
    bool good = node && node.IsSequence() && node.size() == 3;
    for (std::size_t i = 0; good && i < 3; ++i) {
      good = YAML::convert<double>::decode(node[i], x[i]) && std::isfinite(x[i]);
    }
    if (!good) {
      complain("origin", node ? "must be [x, y, yaw], three finite numbers" : "is missing");
    }
    return {x[0], x[1], x[2]};
  }
  Mode mode() {
    const std::string word = value<std::string>("mode", "trinary, scale or raw", "");
    if (word != "trinary" && word != "scale" && word != "raw") {
      complain("mode", "must be trinary, scale or raw");
    }
    return word == "scale" ? Mode::kScale : word == "raw" ? Mode::kRaw : Mode::kTrinary;
  }

  YAML::Node root_;
  std::string problems_;
  std::string faulty_;
};

/// Occupied unless surely free: map_server's rule, with unknown and half occupied taken as
/// occupied. Unlike there, transparent pixels are blank paper in the modes trinary and raw; in the
/// mode scale they are unknown, as there.
Grid<std::uint8_t> occupied_of(const Image& image, const MapServerKeys& keys) {
  std::array<std::uint8_t, 256> table{};
  for (int pixel = 0; pixel < 256; ++pixel) {
    const int value = keys.negate ? 255 - pixel : pixel;
    const double p_occupied = keys.mode == Mode::kRaw ? value / 100.0 : (255 - value) / 255.0;
    table[static_cast<std::size_t>(pixel)] = p_occupied < keys.free_thresh ? 0 : 1;
  }
  cv::Mat occupied;
  cv::LUT(image.gray, cv::Mat{1, 256, CV_8UC1, table.data()}, occupied);
  if (keys.mode == Mode::kScale && !image.transparent.empty()) {
    occupied |= image.transparent;
  }
  return grid_of(occupied);
}

CoarseMap read_map_server(const std::string& path) {
  YAML::Node root;
  try {
    root = YAML::LoadFile(path);
  } catch (const YAML::BadFile&) {
    throw std::runtime_error(path + ": cannot be opened; is the path right and readable?");
  } catch (const YAML::Exception& e) {
    throw std::runtime_error(path + ": is not YAML: " + e.what());
  }
  if (!root.IsMap()) {
    throw std::runtime_error(path +
                             ": holds no keys; a map needs image, resolution, origin, "
                             "negate, occupied_thresh and free_thresh");
  }
  KeyReader reader{root};
  MapServerKeys keys = reader.read();
  if (!reader.problems().empty()) {
    throw std::runtime_error(path + ": " + reader.problems());
  }
  if (keys.image.front() != '/') {
    keys.image = path.substr(0, path.find_last_of('/') + 1) + keys.image;
  }
  return {occupied_of(read_image(keys.image), keys), keys.resolution, keys.T_map_grid};
}

CoarseMap read_array(const std::string& path, double resolution) {
  const Grid<double> values = read_npy(path);
  Grid<std::uint8_t> occupied{values.width(), values.height()};
  for (std::size_t i = 0; i < values.size(); ++i) {
    occupied[i] = values[i] >= 0.0 && values[i] <= 0.5 ? 0 : 1;  // -1 and NaN: unknown
  }
  return {std::move(occupied), resolution};
}

}  // namespace

CoarseMap read_map(const std::string& path, double resolution) {
  if (!(resolution > 0.0) || !std::isfinite(resolution)) {
    throw std::runtime_error(path + ": the resolution must be above 0 m/cell");
  }
  const std::string ending = ending_of(path);
  CoarseMap map;
  if (ending == ".yaml" || ending == ".yml") {
    map = read_map_server(path);
  } else if (ending == ".npy") {
    map = read_array(path, resolution);
  } else {
    map = {grid_of(read_image(path).gray < 128), resolution};
  }
  if (map.free_count() == 0) {
    throw std::runtime_error(path +
                             ": has no free cell; are light pixels (values of 0 in a .npy) "
                             "free in it, and are negate and free_thresh right?");
  }
  return map;
}

}  // namespace cmn
