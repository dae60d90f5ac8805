// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What planning costs: once per goal, and at every decision.
#include "coarse_map_nav/planning/cost_to_go.hpp"
#include "coarse_map_nav/planning/grid_planner.hpp"
#include "coarse_map_nav/planning/planner.hpp"

#include <string>

#include "rooms.hpp"
#include <benchmark/benchmark.h>

namespace cmn {
namespace {

void cost_to_go(benchmark::State& state) {
  const CoarseMap map = rooms(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(CostToGo{map, first_middle()});
  }
  state.counters["cells/s"] = benchmark::Counter(static_cast<double>(map.free_count()),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(cost_to_go)
    ->Args({18, 23})
    ->Args({100, 100})
    ->Args({256, 256})
    ->Args({1024, 1024})
    ->Unit(benchmark::kMicrosecond);

void a_star_across(benchmark::State& state) {
  const CoarseMap map = rooms(static_cast<int>(state.range(0)), static_cast<int>(state.range(0)));
  const auto connectivity = state.range(1) == 4 ? Connectivity::kFour : Connectivity::kEight;
  for (auto _ : state) {
    benchmark::DoNotOptimize(shortest_path(map, last_middle(map), first_middle(), connectivity));
  }
}
BENCHMARK(a_star_across)
    ->ArgNames({"side", "neighbours"})
    ->Args({100, 4})
    ->Args({100, 8})
    ->Unit(benchmark::kMicrosecond);

/// One decision on 100 x 100 cells at the far end of the map.
void decide(benchmark::State& state, const std::string& policy, bool diagonals, bool has_way) {
  const CoarseMap map = rooms(100, 100);
  PlanningParams params;
  params.policy = policy;
  params.tree_diagonals = diagonals;
  params.max_actions = 1000000000;
  Planner planner{map, params};
  if (planner.set_goal(map.center_of(first_middle()))) {
    state.SkipWithError("the goal was refused");
    return;
  }
  const Belief belief = Belief::uniform(map);
  const Cell cell = has_way ? last_middle(map) : Cell{0, 0};
  const Localization localization{belief, {Heading::kEast, cell, 1.0}, 1.0, true};
  for (auto _ : state) {
    benchmark::DoNotOptimize(planner.decide(localization, false));
  }
}
BENCHMARK_CAPTURE(decide, path, "path", false, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(decide, tree, "heuristic_tree", false, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(decide, tree_diagonals, "heuristic_tree", true, true)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(decide, path_without_a_way, "path", false, false)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cmn

BENCHMARK_MAIN();
