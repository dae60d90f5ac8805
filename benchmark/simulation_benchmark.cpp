// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a scan and a second of simulated driving cost.
#include "coarse_map_nav/simulation/simulator.hpp"

#include <cstdint>
#include <utility>

#include <benchmark/benchmark.h>

namespace cmn {
namespace {

/// Rooms of 5 m x 5 m with doors of 1 m and a table in each, 20 m x 20 m at 5 cm.
World rooms() {
  constexpr int kRoom = 100;
  constexpr int kSide = 4 * kRoom;
  Grid<std::uint8_t> occupied{kSide, kSide};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const int in_x = x % kRoom;
      const int in_y = y % kRoom;
      const bool wall =
          (in_x < 2 && (in_y < 40 || in_y >= 60)) || (in_y < 2 && (in_x < 40 || in_x >= 60));
      const bool table = in_x >= 70 && in_x < 90 && in_y >= 20 && in_y < 36;
      occupied({x, y}) = wall || table;
    }
  }
  return World{CoarseMap{std::move(occupied), 0.05}};
}

/// One sweep: the argument is the number of beams.
void scan(benchmark::State& state) {
  SimulationParams params;
  params.lidar.beams = static_cast<int>(state.range(0));
  Simulator simulator{rooms(), params, {7.5, 7.5, 0.3}, 1};
  for (auto _ : state) {
    benchmark::DoNotOptimize(simulator.scan());
  }
}
BENCHMARK(scan)->Arg(360)->Arg(720)->Unit(benchmark::kMicrosecond);

/// The same in the empty hall of 20 m, the longest way for a ray.
void scan_of_a_hall(benchmark::State& state) {
  SimulationParams params;
  params.lidar.range_max_m = 30.0;
  Simulator simulator{
      World{CoarseMap{Grid<std::uint8_t>{400, 400}, 0.05}}, params, {7.5, 7.5, 0.3}, 1};
  for (auto _ : state) {
    benchmark::DoNotOptimize(simulator.scan());
  }
}
BENCHMARK(scan_of_a_hall)->Unit(benchmark::kMicrosecond);

/// A second at 50 commands a second with ten scans, driving in a circle.
void second_of_driving(benchmark::State& state) {
  Simulator simulator{rooms(), {}, {7.5, 7.5, 0.0}, 1};
  for (auto _ : state) {
    for (int i = 0; i < 50; ++i) {
      simulator.advance(0.02, {0.3, 1.0});
      if (i % 5 == 0) {
        benchmark::DoNotOptimize(simulator.scan());
      }
    }
  }
}
BENCHMARK(second_of_driving)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cmn

BENCHMARK_MAIN();
