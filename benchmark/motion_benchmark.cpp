// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What one step of the motion controller costs.
#include "coarse_map_nav/motion/motion_controller.hpp"

#include <cstdint>

#include <benchmark/benchmark.h>

namespace cmn {
namespace {

/// Actions without end on a base that does what it is told.
void controller_step(benchmark::State& state) {
  MotionController controller{MotionParams{}};
  OdometrySample now;
  std::uint32_t id = 0;
  for (auto _ : state) {
    if (controller.is_idle()) {
      const bool turn = id % 2 == 0;
      controller.start(++id, {turn ? ActionType::kTurnLeft : ActionType::kMoveForward, 0.4}, now);
    }
    const MotionStep step = controller.step(now, 10.0, false);
    now.stamp_s += 0.02;
    now.T_odom_robot = now.T_odom_robot * Pose2{0.02 * step.command.linear_mps, 0.0,
                                                0.02 * step.command.angular_radps};
    benchmark::DoNotOptimize(now);
  }
}
BENCHMARK(controller_step);

}  // namespace
}  // namespace cmn

BENCHMARK_MAIN();
