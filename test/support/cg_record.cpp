// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Writes down a run of CMN's filter for cg_reference.py to do again: cg_record MAP.npy SEED STEPS.
///
/// Grid observations with noise, heading known, exponent 2. First line: width, height, heading at
/// the start. Each further line, one a look: the action before it (none, forward, left, right), p
/// of CMN eq. 1, the 3 x 3 observation (robot's axes, x fastest), the belief of the layer of the
/// robot's heading (lowest row first).

#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/localization/belief_filter.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>
#include <string>

namespace {

using cmn::Cell;
using cmn::Heading;

constexpr double kCell_m = 1.0;

/// What is occupied about the robot, blurred by up to 0.3.
cmn::LocalOccupancy look(const cmn::CoarseMap& map, Cell at, Heading heading,
                         std::mt19937_64& rng) {
  cmn::LocalOccupancy seen{3, 1.28 / 3};
  for (int i = 0; i < 9; ++i) {
    const Cell c = at + cmn::turned(Cell{i % 3 - 1, i / 3 - 1}, cmn::index(heading));
    const double blur = 0.3 * cmn::draw_uniform(rng);
    const double occupied = map.is_occupied(c) ? 1.0 - blur : blur;
    seen.occupancy[static_cast<std::size_t>(i)] = static_cast<float>(occupied);
    seen.confidence[static_cast<std::size_t>(i)] = 1.0F;
  }
  return seen;
}

void write_line(const std::string& action, double p, const cmn::LocalOccupancy& seen,
                const cmn::Belief& belief, Heading heading) {
  std::printf("%s %.17g", action.c_str(), p);
  for (const float value : seen.occupancy) {
    std::printf(" %.9g", static_cast<double>(value));
  }
  for (int y = 0; y < belief.height(); ++y) {
    for (int x = 0; x < belief.width(); ++x) {
      std::printf(" %.17g", belief(heading, {x, y}));
    }
  }
  std::printf("\n");
}

void record(const std::string& path, std::uint64_t seed, int steps) {
  const cmn::CoarseMap map = cmn::read_map(path, kCell_m);
  std::mt19937_64 rng{seed};
  Cell at{-1, -1};
  while (!map.is_free(at)) {
    at = map.occupied().cell_at(cmn::draw_index(rng, map.occupied().size()));
  }
  auto heading = static_cast<Heading>(cmn::draw_index(rng, 4));
  // The filter's own p cannot be seen from outside. It is drawn here, by the motion model that
  // draws it there, and handed to the filter as a way of p cells.
  const cmn::NoisyMotionModel noisy{cmn::kCmnStep_m};
  cmn::LocalizationParams params;
  params.motion.type = "scaled";
  params.measurement.exponent = 2.0;
  cmn::BeliefFilter filter{map, params};
  filter.reset_heading(heading);
  std::printf("%d %d %d\n", map.width(), map.height(), cmn::index(heading));

  cmn::Pose2 T_odom_robot;
  std::string action = "none";
  double p = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const cmn::LocalOccupancy seen = look(map, at, heading, rng);
    filter.update(seen, T_odom_robot);
    write_line(action, p, seen, filter.belief(), heading);
    const double lot = cmn::draw_uniform(rng);
    p = 0.0;
    if (lot < 0.7) {
      action = "forward";
      p = noisy.steps({cmn::kCmnStep_m, 0.0, 0}, rng).front().forward;
      T_odom_robot = T_odom_robot * cmn::Pose2{p * kCell_m, 0.0, 0.0};
      const Cell ahead = at + cmn::unit_step(heading);
      at = map.is_free(ahead) && cmn::draw_uniform(rng) < 0.5 ? ahead : at;
    } else {
      const int turn = lot < 0.85 ? 1 : -1;
      action = turn > 0 ? "left" : "right";
      heading = cmn::turned(heading, turn);
      T_odom_robot = T_odom_robot * cmn::Pose2{0.0, 0.0, turn * cmn::kPi / 2.0};
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 4) {
      std::fprintf(stderr, "usage: cg_record MAP.npy SEED STEPS\n");
      return EXIT_FAILURE;
    }
    record(argv[1], std::stoull(argv[2]), std::stoi(argv[3]));
    return EXIT_SUCCESS;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "cg_record: %s\n", e.what());
    return EXIT_FAILURE;
  }
}
