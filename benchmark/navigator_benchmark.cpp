// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a whole step of the default preset costs (local map, measurement, plan), and how that and
/// the memory grow with the map, while the robot is lost and while it knows where it is.
#include "coarse_map_nav/navigator.hpp"
#include "coarse_map_nav/simulation/range_sensor.hpp"
#include "coarse_map_nav/simulation/step_drive.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <random>
#include <string>

#include "office.hpp"
#include <benchmark/benchmark.h>

namespace cmn {
namespace {

NavigatorParams preset(const std::string& name, int scales) {
  NavigatorParams params;
  load_params(read_param_file(std::string{CMN_CONFIG_DIR} + "/" + name), params);
  params.localization.scaled.scales = scales;
  params.planning.max_actions = 1000000;
  return params;
}

/// What /proc/self/status says of this process [MB]; 0 where there is none.
double memory_mb(const std::string& entry) {
  std::ifstream file{"/proc/self/status"};
  for (std::string word; file >> word;) {
    double kib = 0.0;
    if (word == entry + ":" && file >> kib) {
      return kib * 1024.0 / 1e6;
    }
  }
  return 0.0;
}

/// A robot in an office that is drawn as it is.
class Journey {
 public:
  Journey(const CoarseMap& map, const NavigatorParams& params)
      : map_{map},
        world_{map},
        before_mb_{memory_mb("VmRSS")},
        navigator_{map, params},
        robot_{world_, RobotParams{}, *world_.random_free_pose(0.3, places_, 0.0), 1},
        lidar_{LidarParams{}, 1} {
    choose_goal();
  }

  Navigator& navigator() { return navigator_; }
  /// At its most, where it is the first journey of the process.
  double navigator_mb() const { return memory_mb("VmHWM") - before_mb_; }
  void look() { scan_ = lidar_.measure(world_, robot_.truth(), 0.0); }
  void think() { decision_ = navigator_.step(scan_, robot_.T_odom_robot(), outcome_); }
  /// False when there was nothing to do and a new goal is set.
  bool act() {
    if (decision_.state == NavigationState::kReached ||
        decision_.state == NavigationState::kFailed) {
      choose_goal();
      return false;
    }
    outcome_ = robot_.carry_out(decision_.action);
    return true;
  }
  /// Is told about where it is, and drives until it has seen that.
  bool find_itself() {
    navigator_.localizer().reset_near(robot_.truth(), 0.5, 0.1);
    for (int i = 0; i < 40; ++i) {
      look();
      think();
      act();
    }
    return navigator_.localizer().localization().is_converged;
  }

 private:
  void choose_goal() {
    do {
      const auto pose = world_.random_free_pose(0.3, places_, 0.0);
      if (!navigator_.planner().set_goal(pose->position())) {
        return;
      }
    } while (true);
  }

  CoarseMap map_;
  World world_;
  std::mt19937 places_{3};
  double before_mb_;
  Navigator navigator_;
  StepDrive robot_;
  RangeSensor lidar_;
  RangeScan scan_;
  Decision decision_;
  MotionOutcome outcome_ = MotionOutcome::kSucceeded;
};

/// The step after the first look and a drive of 0.15 m: nearly everything is possible still.
void lost(benchmark::State& state, const std::string& name) {
  const CoarseMap map = office(static_cast<int>(state.range(0)));
  Journey journey{map, preset(name, static_cast<int>(state.range(1)))};
  for (auto _ : state) {
    state.PauseTiming();
    journey.navigator().localizer().reset();
    journey.look();
    journey.think();
    journey.act();
    journey.look();
    state.ResumeTiming();
    journey.think();
  }
  state.counters["MB"] = journey.navigator_mb();
  state.counters["free_cells"] = static_cast<double>(map.free_count());
}

/// Steps on the way to far goals. The first step to a new goal is left out: it prepares the map.
void converged(benchmark::State& state, const std::string& name) {
  const CoarseMap map = office(static_cast<int>(state.range(0)));
  Journey journey{map, preset(name, static_cast<int>(state.range(1)))};
  if (!journey.find_itself()) {
    state.SkipWithError("the robot does not find itself");
    return;
  }
  for (auto _ : state) {
    state.PauseTiming();
    while (!journey.act()) {
      journey.look();
      journey.think();
    }
    journey.look();
    state.ResumeTiming();
    journey.think();
  }
  state.counters["MB"] = journey.navigator_mb();
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"side", "scales"})->Unit(benchmark::kMillisecond);
  for (const int side : {100, 200, 400, 1000, 2000}) {
    bench->Args({side, 3});
  }
  bench->Args({100, 5})->Args({400, 5});
}
BENCHMARK_CAPTURE(lost, navigator, "navigator.yaml")->Apply(sizes)->Iterations(3);
BENCHMARK_CAPTURE(lost, rolling, "rolling.yaml")->Apply(sizes)->Iterations(3);
BENCHMARK_CAPTURE(converged, navigator, "navigator.yaml")->Apply(sizes)->Iterations(200);
BENCHMARK_CAPTURE(converged, rolling, "rolling.yaml")->Apply(sizes)->Iterations(200);

}  // namespace
}  // namespace cmn

BENCHMARK_MAIN();
