// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/action_times.hpp"

#include "coarse_map_nav/evaluation/episode.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/mapping/places.hpp"
#include "coarse_map_nav/mapping/regions.hpp"

#include <string>

#include <gtest/gtest.h>

namespace cmn {
namespace {

const std::string kSource = CMN_SOURCE_DIR;

TEST(ActionTimes, AreThoseOfTheSpeedsAndRamps) {
  const MotionParams motion;
  ActionTimes times{RobotParams{}, motion};
  EXPECT_EQ(times.of({ActionType::kStop}), 0.0);
  const double turn_s = times.of({ActionType::kTurnLeft});
  EXPECT_GT(turn_s, kPi / 2.0 / motion.max_angular_radps);
  EXPECT_LT(turn_s, kPi / 2.0 / motion.max_angular_radps + 2.0);
  EXPECT_NEAR(times.of({ActionType::kTurnRight}), turn_s, 0.05);
  const double step_s = times.of({ActionType::kMoveForward, 0.15});
  EXPECT_GT(step_s, 0.15 / motion.max_linear_mps);
  EXPECT_LT(step_s, turn_s);
  EXPECT_GT(times.of({ActionType::kMoveForward, 0.3}), step_s);
}

TEST(ActionTimes, AddUpToThatOfAnEpisodeInTheFullSimulation) {
  const CoarseMap map = largest_region(read_map(kSource + "/maps/home.yaml")).map;
  const MapPlaces places = read_places(kSource + "/maps/home.yaml");
  NavigatorParams params;
  ASSERT_TRUE(load_params(read_param_file(kSource + "/config/navigator.yaml"), params).empty());
  const SimulationParams simulation;
  const EpisodeResult result =
      run_episode(World{read_map(kSource + "/worlds/home.yaml")}, simulation, map, params,
                  {{6.2, 5.5, 0.0}, places.find(places.default_goal)->map}, 1);
  ASSERT_EQ(result.end, NavigationState::kReached);
  ActionTimes times{simulation.robot, params.motion};
  double sum_s = 0.0;
  for (const EpisodeStep& step : result.steps) {
    sum_s += times.of(step.decision.action);
  }
  EXPECT_NEAR(sum_s, result.time_s, 0.1 * result.time_s);
}

}  // namespace
}  // namespace cmn
