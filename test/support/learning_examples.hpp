// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A toy world to learn from: a wall in some of the four directions, whose distance is how much of
/// the view below the horizon it covers.
#pragma once

#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/learning/example_file.hpp"
#include "coarse_map_nav/learning/example_set.hpp"
#include "coarse_map_nav/perception/occupancy_predictor.hpp"

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cmn {

/// Marks what lies beyond a wall across the whole of a square, `distance_m` away to where view k
/// looks.
inline void add_wall(cv::Mat& truth, double side_m, int k, double distance_m) {
  for (int iy = 0; iy < truth.rows; ++iy) {
    for (int ix = 0; ix < truth.cols; ++ix) {
      const double cell_m = side_m / truth.cols;
      const Point2 cell{(ix + 0.5 - 0.5 * truth.cols) * cell_m,
                        (iy + 0.5 - 0.5 * truth.rows) * cell_m};
      if (turned(cell, -k * kPi / 2.0).x > distance_m) {
        truth.at<std::uint8_t>(iy, ix) |= kTruthOccupied;
      }
    }
  }
}

/// White walls over a grey floor, seen from 0.4 m above it.
inline Example toy_example(std::mt19937_64& rng) {
  constexpr double kHeight_m = 0.4;
  Example example;
  for (int k = 0; k < 4; ++k) {
    cv::Mat& view = example.panorama.views[static_cast<std::size_t>(k)];
    view.setTo(cv::Scalar{90, 90, 90});
    view.rowRange(0, kViewSide / 2).setTo(cv::Scalar{40, 30, 30});
    if (draw_index(rng, 2) == 0) {
      continue;
    }
    const double distance_m = 0.3 + 0.9 * draw_uniform(rng);
    add_wall(example.near, kNearSide_m, k, distance_m);
    add_wall(example.wide, kWideSide_m, k, distance_m);
    const int foot = kViewSide / 2 + static_cast<int>(40.0 * kHeight_m / distance_m);
    view.rowRange(0, std::min(foot, kViewSide)).setTo(cv::Scalar{230, 230, 230});
  }
  mark_seen(example.near, kNearSide_m, kPi / 2.0);
  mark_seen(example.wide, kWideSide_m, kPi / 2.0);
  return example;
}

/// A seed of a house in that split.
inline std::uint32_t house_in(Split split, std::uint32_t from = 0) {
  while (split_of(from) != split) {
    ++from;
  }
  return from;
}

/// An empty folder of the running test's own.
inline std::string fresh_folder(const std::string& name) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string path =
      ::testing::TempDir() + test->test_suite_name() + "_" + test->name() + "_" + name;
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path;
}

/// A folder with a house of `count` toy examples in each split.
inline std::string toy_folder(std::size_t count) {
  const std::string folder = fresh_folder("examples");
  std::mt19937_64 rng{5};
  for (const Split split : {Split::kTrain, Split::kValidation, Split::kTest}) {
    std::vector<Example> examples;
    for (std::size_t i = 0; i < count; ++i) {
      examples.push_back(toy_example(rng));
    }
    write_examples(folder + "/" + name(split) + ".h5", house_in(split), examples);
  }
  return folder;
}

}  // namespace cmn
