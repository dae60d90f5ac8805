// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A controller that drives a simulated base.
#pragma once

#include "coarse_map_nav/motion/motion_controller.hpp"
#include "coarse_map_nav/simulation/simulator.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace cmn {

/// A square hall with nothing in it.
inline World empty_hall(double side_m) {
  const int cells = static_cast<int>(side_m);
  return World{CoarseMap{Grid<std::uint8_t>{cells, cells}, 1.0}};
}

constexpr double kNothingAhead = std::numeric_limits<double>::infinity();

/// 50 odometry samples a second, as the Kobuki sends them.
class SimulatedDrive {
 public:
  static constexpr double kPeriod_s = 0.02;

  SimulatedDrive(Simulator& simulator, const MotionParams& params)
      : simulator_{simulator}, controller_{params} {}

  /// One period. Every command is kept.
  std::optional<MotionResult> tick(double clear_ahead_m = kNothingAhead) {
    const MotionStep step =
        controller_.step(simulator_.odometry(), clear_ahead_m, simulator_.bumped());
    commands.push_back(step.command);
    simulator_.advance(kPeriod_s, step.command);
    return step.result;
  }
  MotionResult run(const Action& action) {
    controller_.start(++last_id_, action, simulator_.odometry());
    for (int i = 0; i < 3000; ++i) {
      if (const auto result = tick()) {
        return *result;
      }
    }
    throw std::runtime_error("the action did not end within a minute");
  }
  MotionController& controller() { return controller_; }

  std::vector<VelocityCommand> commands;

 private:
  Simulator& simulator_;
  MotionController controller_;
  std::uint32_t last_id_ = 0;
};

}  // namespace cmn
