// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a look costs: a scan to local occupancy, and the whole see-believe-plan step after it.
#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/navigator.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

#include <cmath>

#include "rooms.hpp"
#include <benchmark/benchmark.h>

namespace cmn {
namespace {

/// 360 beams in a room of 5 m x 4 m, about a tenth of them on furniture.
RangeScan room_scan() {
  std::mt19937_64 rng{3};
  RangeScan scan;
  scan.angle_min_rad = -kPi;
  scan.angle_increment_rad = 2.0 * kPi / 360.0;
  scan.range_min_m = 0.15;
  scan.range_max_m = 10.0;
  for (int beam = 0; beam < 360; ++beam) {
    const double bearing = scan.angle_min_rad + beam * scan.angle_increment_rad;
    const double to_wall_m = std::min(2.5 / std::max(std::abs(std::cos(bearing)), 1e-9),
                                      2.0 / std::max(std::abs(std::sin(bearing)), 1e-9));
    const double share = draw_uniform(rng) < 0.1 ? 0.3 : 1.0;
    scan.ranges_m.push_back(static_cast<float>(share * to_wall_m + 0.01 * draw_normal(rng)));
  }
  return scan;
}

/// 360 beams -> 128 x 128 cells, CMN's local occupancy.
void scan_to_occupancy(benchmark::State& state) {
  RangeProjector projector{ProjectionParams{}};
  const RangeScan scan = room_scan();
  for (auto _ : state) {
    benchmark::DoNotOptimize(projector.project(scan));
  }
}
BENCHMARK(scan_to_occupancy)->Unit(benchmark::kMicrosecond);

/// See, believe, plan on 100 x 100 cells; the robot has gone a step, or made a quarter turn at
/// every 16th look. `off_axis_rad`: between the odometry's axes the observation is turned back.
void see_believe_plan(benchmark::State& state, const NavigatorParams& given, double off_axis_rad) {
  const CoarseMap map = rooms(100, 100);
  NavigatorParams params = given;
  params.planning.max_actions = 1000000000;
  params.planning.reached_confidence = 1.0;  // the journey never ends
  Navigator navigator{map, params};
  if (navigator.planner().set_goal(map.center_of(first_middle()))) {
    state.SkipWithError("the goal was refused");
    return;
  }
  const RangeScan scan = room_scan();
  Pose2 T_odom_robot{0.0, 0.0, off_axis_rad};
  int look = 0;
  for (auto _ : state) {
    look = (look + 1) % 16;
    T_odom_robot =
        T_odom_robot * (look == 0 ? Pose2{0.0, 0.0, kPi / 2.0} : Pose2{kCmnStep_m, 0.0, 0.0});
    benchmark::DoNotOptimize(navigator.step(scan, T_odom_robot, MotionOutcome::kSucceeded));
  }
}

/// A longer look, compared with 9 x 9 cells of the drawing.
NavigatorParams nine_by_nine() {
  NavigatorParams params;
  params.perception.local_occupancy = {96, 3.84, 0.4};
  params.localization.motion.type = "scaled";
  params.localization.measurement.window_reach = 4;
  params.localization.measurement.window_m = 3.84;
  params.localization.measurement.unseen_is_occupied = false;
  params.localization.measurement.exponent = 4.0;
  return params;
}
BENCHMARK_CAPTURE(see_believe_plan, papers, NavigatorParams{}, 0.0)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(see_believe_plan, papers_off_axis, NavigatorParams{}, 0.2)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(see_believe_plan, nine_by_nine, nine_by_nine(), 0.0)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cmn

BENCHMARK_MAIN();
