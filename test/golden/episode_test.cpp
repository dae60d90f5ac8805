// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whole journeys as text: what changes how the robot behaves shows as a difference to read.
///
/// CMN_UPDATE_GOLDEN=1 writes the files anew; the reason goes into the commit.
#include "coarse_map_nav/evaluation/episode.hpp"

#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/mapping/places.hpp"
#include "coarse_map_nav/mapping/regions.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr int kActions = 60;

NavigatorParams papers() {
  NavigatorParams params;
  const auto problems = load_params(read_param_file(CMN_SOURCE_DIR "/config/cmn.yaml"), params);
  EXPECT_TRUE(problems.empty());
  return params;
}

/// A longer look, only what was seen, measured steps. Fixed here: presets are free to be tuned.
NavigatorParams farther() {
  NavigatorParams params;
  params.perception.local_occupancy = {72, 3.6, 0.4};
  params.localization.contradiction_evidence = 0.0;
  params.localization.motion.type = "scaled";
  params.localization.measurement.window_reach = 4;
  params.localization.measurement.window_m = 3.6;
  params.localization.measurement.unseen_is_occupied = false;
  params.localization.measurement.exponent = 5.0;
  return params;
}

const char* name_of(ActionType action) {
  constexpr std::array<const char*, 4> kNames{"stop", "forward", "left", "right"};
  return kNames[static_cast<std::size_t>(action)];
}
const char* name_of(MotionOutcome outcome) {
  constexpr std::array<const char*, 4> kNames{"succeeded", "blocked", "timed_out", "preempted"};
  return kNames[static_cast<std::size_t>(outcome)];
}
const char* name_of(NavigationState state) {
  constexpr std::array<const char*, 6> kNames{"waiting", "localizing", "navigating",
                                              "reached", "failed",     "stopped"};
  return kNames[static_cast<std::size_t>(state)];
}

/// -0.00 is written as 0.00.
double rounded(double value, double unit) { return std::round(value / unit) * unit + 0.0; }

/// In {0 .. 359}: the way round does not hang on a last digit at half a turn.
int degrees_of(double yaw_rad) {
  return (static_cast<int>(std::lround(yaw_rad * 180.0 / kPi)) + 360) % 360;
}

std::string text_of(const EpisodeResult& result) {
  std::ostringstream text;
  text << "  # action   outcome    state       estimate      conf   truth x     y  yaw\n";
  std::array<char, 160> line{};
  for (std::size_t i = 0; i < result.steps.size(); ++i) {
    const EpisodeStep& step = result.steps[i];
    std::snprintf(line.data(), line.size(),
                  "%3zu %-8s %-10s %-11s %3d %3d %c  %6.3f  %7.2f %5.2f %4d\n", i + 1,
                  name_of(step.decision.action.type), name_of(step.outcome),
                  name_of(step.decision.state), step.estimate.cell.x, step.estimate.cell.y,
                  "ENWS"[index(step.estimate.heading)], rounded(step.confidence, 1e-3),
                  rounded(step.T_world_robot.x, 0.01), rounded(step.T_world_robot.y, 0.01),
                  degrees_of(step.T_world_robot.yaw));
    text << line.data();
  }
  text << name_of(result.end) << ": " << result.reason << "\n";
  return text.str();
}

std::string content_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream{path}.rdbuf();
  return text.str();
}

void expect_as_written(const std::string& world, const std::string& preset, NavigatorParams params,
                       const Pose2& T_world_start, std::uint32_t seed) {
  const std::string map_path = CMN_SOURCE_DIR "/maps/" + world + ".yaml";
  const MapPlaces places = read_places(map_path);
  const Place* goal = places.find(places.default_goal);
  ASSERT_NE(goal, nullptr);
  params.localization.seed = params.planning.seed = seed;
  params.planning.max_actions = kActions;
  const EpisodeResult result =
      run_episode(World{read_map(CMN_SOURCE_DIR "/worlds/" + world + ".yaml")}, SimulationParams{},
                  largest_region(read_map(map_path)).map, params, {T_world_start, goal->map}, seed);
  const std::string text = text_of(result);
  const std::string path = CMN_SOURCE_DIR "/test/golden/" + world + "_" + preset + ".txt";
  if (std::getenv("CMN_UPDATE_GOLDEN") != nullptr) {
    std::ofstream{path} << text;
  }
  EXPECT_EQ(content_of(path), text) << "CMN_UPDATE_GOLDEN=1 writes " << path << " anew";
}

TEST(GoldenEpisode, HomeByThePapers) {
  expect_as_written("home", "papers", papers(), {6.2, 5.5, 0.0}, 1);
}
TEST(GoldenEpisode, HomeLookingFarther) {
  expect_as_written("home", "farther", farther(), {6.2, 5.5, 0.0}, 2);
}
TEST(GoldenEpisode, LabByThePapers) {
  expect_as_written("lab", "papers", papers(), {9.5, 7.6, -kPi / 2.0}, 3);
}
TEST(GoldenEpisode, LabLookingFarther) {
  expect_as_written("lab", "farther", farther(), {9.5, 7.6, -kPi / 2.0}, 4);
}

}  // namespace
}  // namespace cmn
