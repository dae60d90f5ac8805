// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/navigator.hpp"

#include "coarse_map_nav/evaluation/episode.hpp"
#include "coarse_map_nav/mapping/map_reader.hpp"
#include "coarse_map_nav/mapping/places.hpp"
#include "coarse_map_nav/mapping/regions.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace cmn {
namespace {

const std::string kSource = CMN_SOURCE_DIR;

TEST(Navigator, ASensorThatSeesAQuarterArrivesByTurningRoundAtEveryStop) {
  const CoarseMap map = largest_region(read_map(kSource + "/maps/home.yaml")).map;
  const MapPlaces places = read_places(kSource + "/maps/home.yaml");
  const Place* goal = places.find(places.default_goal);
  ASSERT_NE(goal, nullptr);
  NavigatorParams params;
  ASSERT_TRUE(load_params(read_param_file(kSource + "/config/navigator.yaml"), params).empty());
  params.perception.accumulate = "panorama";
  SimulationParams simulation;
  simulation.lidar.field_of_view_deg = 90.0;
  const EpisodeResult result =
      run_episode(World{read_map(kSource + "/worlds/home.yaml")}, simulation, map, params,
                  {{6.2, 5.5, 0.0}, goal->map}, 1);
  EXPECT_EQ(result.end, NavigationState::kReached) << result.reason;
  int pivots = 0;
  int actions = 0;
  for (const EpisodeStep& step : result.steps) {
    pivots += step.decision.is_pivot;
    actions += !step.decision.is_pivot;
    EXPECT_TRUE(!step.decision.is_pivot || step.decision.action.type == ActionType::kTurnLeft);
  }
  EXPECT_GE(pivots, 8) << "four at least at two stops";
  EXPECT_EQ(pivots % 4, 0) << "a panorama ends where it began";
  EXPECT_LE(actions, params.planning.max_actions);
}

TEST(Navigator, RemembersWhatItRanIntoWithoutSeeingIt) {
  const CoarseMap map = largest_region(read_map(kSource + "/maps/home.yaml")).map;
  NavigatorParams params;
  ASSERT_TRUE(load_params(read_param_file(kSource + "/config/navigator.yaml"), params).empty());
  Navigator navigator{map, params};
  RangeScan scan;
  scan.angle_increment_rad = kPi / 180.0;
  scan.range_min_m = 0.1;
  scan.range_max_m = 8.0;
  scan.ranges_m.assign(360, 3.0F);
  const auto most_near = [&navigator](double most_m) {
    const LocalOccupancy& local = navigator.local_map();
    const int half = static_cast<int>(most_m / local.resolution);
    const int centre = local.size / 2;
    float most = 0.0F;
    for (int iy = -half; iy < half; ++iy) {
      for (int ix = -half; ix < half; ++ix) {
        most = std::max(most, local.occupancy[local.index_of(centre + ix, centre + iy)]);
      }
    }
    return most;
  };
  navigator.step(scan, {}, MotionOutcome::kSucceeded);
  EXPECT_LT(most_near(0.5), 0.5F);
  navigator.step(scan, {}, MotionOutcome::kBlocked);
  EXPECT_EQ(most_near(0.5), 1.0F);
}

}  // namespace
}  // namespace cmn
