// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a step of the discrete Bayes filter costs, beside a plain pass over as much memory.
#include "coarse_map_nav/data/belief.hpp"
#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/localization/belief_filter.hpp"

#include <array>
#include <cstdint>
#include <vector>

#include "rooms.hpp"
#include <benchmark/benchmark.h>

namespace cmn {
namespace {

/// CMN's observation already reduced: 3 x 3 values over 1.28 m.
std::vector<LocalOccupancy> observations(std::size_t count) {
  std::mt19937_64 rng{7};
  std::vector<LocalOccupancy> seen(count, LocalOccupancy{3, 1.28 / 3.0});
  for (LocalOccupancy& look : seen) {
    for (std::size_t i = 0; i < look.cell_count(); ++i) {
      look.occupancy[i] = static_cast<float>(draw_uniform(rng));
      look.confidence[i] = 1.0F;
    }
  }
  return seen;
}

void on_cells(benchmark::State& state, const CoarseMap& map) {
  state.counters["cells/s"] = benchmark::Counter(4.0 * static_cast<double>(map.occupied().size()),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

/// Predict, correct, normalise, find the estimate: all that an observation causes. The robot goes
/// forward by CMN's step, with a turn at every 16th look.
void filter_step(benchmark::State& state) {
  const CoarseMap map = rooms(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  BeliefFilter filter{map, LocalizationParams{}};
  const std::vector<LocalOccupancy> seen = observations(16);
  Pose2 T_odom_robot;
  std::size_t look = 0;
  const auto step = [&] {
    look = (look + 1) % seen.size();
    T_odom_robot =
        T_odom_robot * (look == 0 ? Pose2{0.0, 0.0, kPi / 2.0} : Pose2{kCmnStep_m, 0.0, 0.0});
    benchmark::DoNotOptimize(filter.update(seen[look], T_odom_robot));
  };
  // The first steps fetch the memory, and all cells are equally good still.
  for (int i = 0; i < 4; ++i) {
    step();
  }
  for (auto _ : state) {
    step();
  }
  on_cells(state, map);
}

/// out = k * in over arrays like those of a belief: the least that a step could do.
void streaming_pass(benchmark::State& state) {
  const CoarseMap map = rooms(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  Belief in = Belief::uniform(map);
  Belief out{map.width(), map.height()};
  for (auto _ : state) {
    for (const Heading h : kHeadings) {
      const double* source = in.layer(h).data();
      double* target = out.layer(h).data();
      for (std::size_t i = 0; i < in.padded_size(); ++i) {
        target[i] = 0.999 * source[i];
      }
    }
    benchmark::ClobberMemory();
  }
  on_cells(state, map);
}

/// The same within one set of arrays: no line of memory is fetched only to be overwritten.
void streaming_pass_in_place(benchmark::State& state) {
  const CoarseMap map = rooms(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  Belief belief = Belief::uniform(map);
  double k = 0.5;
  for (auto _ : state) {
    k = 1.0 / k;  // 2, 1/2, 2, ...: the values stay normal numbers
    for (const Heading h : kHeadings) {
      for (double& weight : belief.layer(h)) {
        weight *= k;
      }
    }
    benchmark::ClobberMemory();
  }
  on_cells(state, map);
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->Args({18, 23})->Args({256, 256})->Args({1024, 1024})->Args({4096, 4096});
  bench->Unit(benchmark::kMicrosecond);
}
BENCHMARK(streaming_pass)->Apply(sizes);
BENCHMARK(streaming_pass_in_place)->Apply(sizes);
BENCHMARK(filter_step)->Apply(sizes);

}  // namespace
}  // namespace cmn

BENCHMARK_MAIN();
