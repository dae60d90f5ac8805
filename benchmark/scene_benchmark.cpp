// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the sensors of the 3D simulator cost: in the small house (in $CMN_DATA_DIR, else beside the
/// package), where it is there, and in a generated house.
#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/scene/ray_cast_sensors.hpp"
#include "coarse_map_nav/scene/scene_world.hpp"
#include "coarse_map_nav/simulation/world.hpp"

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace cmn {
namespace {

std::string small_house() {
  const char* set = std::getenv("CMN_DATA_DIR");
  return (set != nullptr ? std::string{set} : CMN_CONFIG_DIR "/../../shared/data") +
         "/small_house/worlds/small_house.world";
}

/// A world with its rays, and places all over it to look from.
struct Stage {
  std::shared_ptr<const RayCaster> caster;
  std::vector<Pose2> places;
};

const Stage& stage(const std::string& name) {
  static std::map<std::string, Stage> stages;
  const auto [at, is_new] = stages.emplace(name, Stage{});
  if (is_new) {
    const SceneWorld world = open_scene_world(name);
    at->second.caster = make_ray_caster(world.scene);
    const World body{world.body};
    std::mt19937 rng{1};
    for (int i = 0; i < 64; ++i) {
      const auto place = body.random_free_pose(0.25, rng, kPi / 4.0);
      at->second.places.push_back(place.value());
    }
  }
  return at->second;
}

/// LoCoBot's, about.
SensorMounts mounts() {
  SensorMounts made;
  made.T_robot_lidar.translation() = Eigen::Vector3d{0.0, 0.0, 0.2};
  made.T_robot_depth.translation() = Eigen::Vector3d{0.1, 0.0, 0.6};
  made.T_robot_depth.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  made.T_robot_color = made.T_robot_depth;
  return made;
}

/// Runs `look` from one place after another.
template <class Look>
void run(benchmark::State& state, const std::string& name, const RayCastSensorParams& params,
         const Look& look) {
  if (name.rfind("house:", 0) != 0 && !std::filesystem::exists(name)) {
    state.SkipWithError((name + " is absent").c_str());
    return;
  }
  const Stage& on = stage(name);
  RayCastSensors sensors{on.caster, params, mounts(), 1};
  std::size_t i = 0;
  for (auto _ : state) {
    look(sensors, on.places[i++ % on.places.size()]);
  }
  state.counters["Hz"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void lidar_640(benchmark::State& state, const std::string& name) {
  RayCastSensorParams params;
  params.lidar.beams = 640;
  run(state, name, params, [](RayCastSensors& sensors, const Pose2& at) {
    benchmark::DoNotOptimize(sensors.scan(at, 0.0));
  });
}

void depth_320x240(benchmark::State& state, const std::string& name) {
  run(state, name, {}, [](RayCastSensors& sensors, const Pose2& at) {
    benchmark::DoNotOptimize(sensors.depth(at, 0.0));
  });
}

/// Without noise and faults: the rays alone.
void true_depth_320x240(benchmark::State& state, const std::string& name) {
  run(state, name, {}, [](RayCastSensors& sensors, const Pose2& at) {
    benchmark::DoNotOptimize(sensors.true_depth(at, 0.0));
  });
}

/// Four images of 80 x 80, a quarter turn apart.
void panorama_4x80x80(benchmark::State& state, const std::string& name, int samples) {
  RayCastSensorParams params;
  params.color.samples = samples;
  run(state, name, params, [](RayCastSensors& sensors, const Pose2& at) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      benchmark::DoNotOptimize(sensors.color({at.x, at.y, at.yaw + quarter * kPi / 2.0}, 0.0));
    }
  });
}

BENCHMARK_CAPTURE(lidar_640, small_house, small_house());
BENCHMARK_CAPTURE(depth_320x240, small_house, small_house());
BENCHMARK_CAPTURE(true_depth_320x240, small_house, small_house());
BENCHMARK_CAPTURE(panorama_4x80x80, small_house, small_house(), 1);
BENCHMARK_CAPTURE(panorama_4x80x80, small_house_smoothed, small_house(), 2);
BENCHMARK_CAPTURE(lidar_640, house, "house:3");
BENCHMARK_CAPTURE(depth_320x240, house, "house:3");
BENCHMARK_CAPTURE(panorama_4x80x80, house, "house:3", 1);

}  // namespace
}  // namespace cmn

BENCHMARK_MAIN();
