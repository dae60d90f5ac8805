// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/simulation/simulator.hpp"

#include <cassert>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace cmn {
namespace {

constexpr double kLongestStep_s = 0.005;
/// Any other number would do: it keeps the LiDAR's generator apart from the base's.
constexpr std::uint32_t kSensorSeed = 0x9e3779b9U;

}  // namespace

Simulator::Simulator(World world, const SimulationParams& params, const Pose2& T_world_start,
                     std::uint32_t seed, const Pose2& T_robot_lidar)
    : world_{std::move(world)},
      params_{params},
      robot_{params.robot, T_world_start, seed},
      sensor_{params.lidar, seed ^ kSensorSeed, T_robot_lidar} {
  require_free(T_world_start);
}

void Simulator::advance(double dt_s, const VelocityCommand& command) {
  assert(dt_s > 0.0);
  const int steps = static_cast<int>(std::ceil(dt_s / kLongestStep_s - 1e-9));
  const double start_s = time_s_;
  for (int i = 0; i < steps; ++i) {
    robot_.step(world_, start_s + dt_s * i / steps, dt_s / steps, command);
  }
  time_s_ = start_s + dt_s;
}

void Simulator::set_truth(const Pose2& T_world_robot) {
  require_free(T_world_robot);
  robot_.set_truth(T_world_robot);
}

void Simulator::require_free(const Pose2& T_world_robot) const {
  if (!world_.is_disc_free(T_world_robot.position(), params_.robot.radius_m)) {
    std::ostringstream text;
    text << "the robot (radius " << params_.robot.radius_m << " m) cannot stand at ("
         << T_world_robot.x << ", " << T_world_robot.y
         << "): an obstacle or the edge of the world is in the way; choose a freer place";
    throw std::invalid_argument(text.str());
  }
}

}  // namespace cmn
