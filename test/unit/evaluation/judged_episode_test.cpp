// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/judged_episode.hpp"

#include "coarse_map_nav/simulation/planar_sensors.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ascii_map.hpp"
#include "box_room.hpp"
#include "fake_predictor.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

const std::string kConfig = CMN_SOURCE_DIR "/config";

double no_clock() { return 0.0; }

/// Pixels of 0.1 m for each character of 1 m.
CoarseMap building(const std::vector<std::string>& lines) {
  std::vector<std::string> fine;
  for (const std::string& line : lines) {
    std::string row;
    for (const char c : line) {
      row += std::string(10, c);
    }
    fine.insert(fine.end(), 10, row);
  }
  return ascii_map(fine, 0.1);
}

/// A corridor of 10 m x 1 m.
Scene corridor(const JudgeParams& judge = {}) {
  return {"corridor", building({"############", "#..........#", "############"}), std::nullopt,
          judge};
}

Scene flat(const JudgeParams& judge = {}) {
  return {"flat",
          building(
              {"##########", "#...#....#", "#........#", "#...##.###", "#........#", "##########"}),
          std::nullopt, judge};
}

/// All that an episode needs, with defaults.
struct Setting {
  std::string task = "CL";
  std::string method = "oracle";
  JudgeParams judge;
  std::uint64_t seed = 5;
  std::optional<int> max_actions;
};

EpisodeRow run(const Scene& scene, const Route& route, const Setting& setting,
               const EpisodeRecorder& recorder = {}) {
  const Task& task = find_task(setting.task);
  const Method& method = find_method(setting.method);
  NavigatorParams params = method_params(method, task, kConfig);
  params.planning.max_actions = setting.max_actions.value_or(params.planning.max_actions);
  const Drawing drawing = draw(task, scene.map, nullptr, 0.5, 1, 0.18);
  return run_judged_episode(scene, task, drawing, route, method, params, setting.judge,
                            {setting.task, scene.name, 0.5, setting.method, 0, setting.seed},
                            no_clock, recorder, std::make_shared<FakePredictor>());
}

/// 5 m along the corridor.
Route along(double yaw_rad) { return {{2.05, 1.55, yaw_rad}, {7.05, 1.55}, 5.0}; }

TEST(JudgedEpisode, OfAStraightWayHasTheSplByHand) {
  const Scene scene = corridor();
  const EpisodeRow row = run(scene, along(0.0), {});
  EXPECT_TRUE(row.is_success);
  // 4.6 m are 31 steps of 0.15 m; slip may make it one more or less.
  EXPECT_NEAR(row.success_actions, 31, 1);
  EXPECT_NEAR(row.success_driven_m, 4.65, 0.2);
  EXPECT_EQ(row.spl(), 1.0);  // it need not come all the way: 5 / max(5, 4.65)
  EXPECT_EQ(row.collisions, 0);
  EXPECT_GE(row.actions, row.success_actions);
  EXPECT_EQ(row.T_world_start.x, 2.05);
  EXPECT_EQ(row.goal_world.x, 7.05);
  EXPECT_EQ(row.shortest_m, 5.0);
}

TEST(JudgedEpisode, TurnsCountAsActionsButNotAsWay) {
  const EpisodeRow row = run(corridor(), along(kPi), {});
  EXPECT_TRUE(row.is_success);
  EXPECT_NEAR(row.success_actions, 33, 1);
  EXPECT_NEAR(row.success_driven_m, 4.65, 0.2);
}

TEST(JudgedEpisode, ADetourCostsItsShareOfSpl) {
  // The same ride against a way that is said to be 2 m.
  Route route = along(0.0);
  route.shortest_m = 2.0;
  const EpisodeRow row = run(corridor(), route, {});
  EXPECT_TRUE(row.is_success);
  EXPECT_DOUBLE_EQ(row.spl(), 2.0 / row.success_driven_m);
}

TEST(JudgedEpisode, SuccessComesWithTheFirstPlaceWithinTheRadiusAndNoEarlier) {
  for (const std::string method : {"oracle", "true_pose", "cmn", "robb", "rnd"}) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      SCOPED_TRACE(method + " seed " + std::to_string(seed));
      Setting setting;
      setting.method = method;
      setting.seed = seed;
      setting.max_actions = 80;
      std::vector<Pose2> places;
      const Route route = along(0.0);
      const EpisodeRow row = run(corridor(), route, setting, [&](const EpisodeMoment& moment) {
        places.push_back(moment.T_world_robot);
      });
      const auto within = std::find_if(places.begin(), places.end(), [&](const Pose2& place) {
        return norm(place.position() - route.goal_world) < 0.4;
      });
      ASSERT_EQ(row.is_success, within != places.end());
      if (row.is_success) {
        EXPECT_EQ(row.success_actions, within - places.begin());
      }
      double closest_m = 100.0;
      for (const Pose2& place : places) {
        closest_m = std::min(closest_m, norm(place.position() - route.goal_world));
      }
      EXPECT_DOUBLE_EQ(row.closest_m, closest_m);
      EXPECT_EQ(row.actions + 1, static_cast<int>(places.size()));
      EXPECT_LE(row.actions, 80);
    }
  }
}

TEST(JudgedEpisode, ADeclaredArrivalIsRightWithinItsRadius) {
  Setting setting;
  setting.method = "true_pose";
  EpisodeRow row = run(corridor(), along(0.0), setting);
  EXPECT_EQ(row.end, "reached");
  EXPECT_TRUE(row.is_declared);
  EXPECT_TRUE(row.is_declared_right);
  setting.judge.declared_radius_m = 0.0;
  row = run(corridor(), along(0.0), setting);
  EXPECT_TRUE(row.is_declared);
  EXPECT_FALSE(row.is_declared_right);
}

TEST(JudgedEpisode, EndsWithTheJudgesSuccessWhereTheMethodLeavesThatToHim) {
  Setting setting;
  setting.task = "CG";
  setting.method = "cmn";
  for (setting.seed = 0; setting.seed < 5; ++setting.seed) {
    const EpisodeRow row = run(flat(), {{1.55, 1.55, 0.0}, {6.55, 1.55}, 5.0}, setting);
    EXPECT_EQ(row.end, row.is_success ? "success" : "horizon");
    EXPECT_EQ(row.actions, row.is_success ? row.success_actions : 500);
  }
}

TEST(JudgedEpisode, EndsAtTheHorizon) {
  for (const std::string method : {"ours", "rnd", "robb", "mcse"}) {
    Setting setting;
    setting.method = method;
    setting.max_actions = 7;
    const EpisodeRow row = run(corridor(), along(kPi), setting);
    EXPECT_EQ(row.end, "horizon") << method;
    EXPECT_EQ(row.actions, 7);
    EXPECT_FALSE(row.is_success);
    EXPECT_EQ(row.spl(), 0.0);
  }
}

TEST(JudgedEpisode, TheBoundsArriveInAFlat) {
  const JudgeParams judge;
  const Scene scene = flat(judge);
  const Task& task = find_task("CL");
  const Drawing drawing = draw(task, scene.map, nullptr, 0.5, 1, 0.18);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto route = sample_route(scene, drawing, judge, seed);
    ASSERT_TRUE(route);
    Setting setting;
    for (const std::string method : {"oracle", "true_pose"}) {
      setting.method = method;
      const EpisodeRow row = run(scene, *route, setting);
      EXPECT_TRUE(row.is_success) << method;
      EXPECT_GT(row.spl(), 0.6) << method;
    }
  }
}

TEST(JudgedEpisode, TheSameSeedGivesTheSameRowForEveryMethod) {
  const Scene scene = flat();
  for (const std::string& method : method_names()) {
    const PerceptionParams perception =
        method_params(find_method(method), find_task("CL"), kConfig).perception;
    if (perception.uses_depth() || perception.uses_color()) {
      continue;  // in a plane there is nothing for a camera
    }
    for (const std::string task : {"CG", "CL", "HL"}) {
      Setting setting;
      setting.task = task;
      setting.method = method;
      setting.max_actions = 15;
      const Route route{{1.55, 1.55, 0.0}, {6.55, 1.55}, 5.0};
      EXPECT_EQ(csv_line(run(scene, route, setting)), csv_line(run(scene, route, setting)))
          << method << " " << task;
    }
  }
}

TEST(JudgedEpisode, TheTruthThatARecorderSeesLiesOnTheMapOfTheMethod) {
  const Scene scene = flat();
  for (const std::string method : {"cmn", "rmn", "oracle"}) {
    Setting setting;
    setting.method = method;
    setting.max_actions = 30;
    int free = 0;
    int all = 0;
    run(scene, {{1.55, 1.55, 0.0}, {6.55, 1.55}, 5.0}, setting, [&](const EpisodeMoment& moment) {
      // To scale, and in the frame of the world: a coarse grid.
      EXPECT_NEAR(norm(moment.T_map_true.position() - moment.T_world_robot.position()), 0.0, 1e-6);
      free += moment.map.is_free(moment.map.cell_of(moment.T_map_true.position()));
      ++all;
    });
    EXPECT_GT(free, 0.8 * all) << method;
  }
}

TEST(JudgedEpisode, AKidnappedRobotIsPutDownElsewhereOnceAndJudgedFromThereOn) {
  const JudgeParams judge;
  const Scene scene = flat(judge);
  const Drawing drawing = draw(find_task("CLK"), scene.map, nullptr, 0.5, 1, 0.18);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto route = sample_route(scene, drawing, judge, seed);
    ASSERT_TRUE(route);
    Setting setting;
    setting.task = "CLK";
    setting.method = "true_pose";
    setting.seed = seed;
    std::vector<Pose2> places;
    std::vector<Pose2> counted;
    const EpisodeRow row = run(scene, *route, setting, [&](const EpisodeMoment& moment) {
      places.push_back(moment.T_world_robot);
      counted.push_back(moment.T_odom_robot);
    });
    ASSERT_GE(row.drop_actions, 0);
    int leaps = 0;
    for (std::size_t i = 1; i < places.size(); ++i) {
      const bool is_leap = norm(places[i].position() - places[i - 1].position()) > 0.5;
      leaps += is_leap;
      EXPECT_LT(norm(counted[i].position() - counted[i - 1].position()), 0.5);
      if (is_leap) {
        EXPECT_EQ(places[i].x, row.T_world_drop.x);
        EXPECT_EQ(places[i].y, row.T_world_drop.y);
        EXPECT_GE(norm(places[i].position() - places[i - 1].position()), 1.5);
      }
    }
    EXPECT_EQ(leaps, 1);
    EXPECT_TRUE(row.is_success);
    EXPECT_GE(row.success_actions, row.drop_actions);
    EXPECT_EQ(row.recovered_actions, 0);  // it is told
    EXPECT_GT(row.spl(), 0.6);
    EXPECT_EQ(row.confidence.looks(), 0);  // nor is its confidence its own
  }
}

TEST(JudgedEpisode, WhoNeverKnewWhereItWasIsKidnappedInTheEnd) {
  Setting setting;
  setting.task = "CLK";
  setting.method = "rnd";
  setting.judge.kidnap.latest_actions = 7;
  setting.max_actions = 30;
  const EpisodeRow row = run(flat(), {{1.55, 1.55, 0.0}, {6.55, 1.55}, 5.0}, setting);
  EXPECT_EQ(row.drop_actions, 7);
  EXPECT_EQ(row.recovered_actions, -1);
  EXPECT_EQ(row.actions, 30);
  EXPECT_EQ(row.confidence.looks(), 31);
}

TEST(SampleDrop, IsTheSamePlaceWhereverTheRobotIsUnlessItIsThere) {
  const JudgeParams judge;
  const Scene scene = flat(judge);
  const Point2 goal{6.55, 1.55};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto first = sample_drop(scene.routes, judge, {1.55, 4.55, 0.0}, goal, seed);
    ASSERT_TRUE(first);
    const auto elsewhere = sample_drop(scene.routes, judge, first->T_world_start, goal, seed);
    ASSERT_TRUE(elsewhere);
    EXPECT_GE(norm(elsewhere->T_world_start.position() - first->T_world_start.position()), 1.5);
    // From a place that both of them are far from, it is the first again.
    const Pose2 far{1.55, 4.45, 1.0};
    const auto again = sample_drop(scene.routes, judge, far, goal, seed);
    ASSERT_TRUE(again);
    if (norm(first->T_world_start.position() - far.position()) > 3.0) {
      EXPECT_EQ(again->T_world_start.x, first->T_world_start.x);
      EXPECT_EQ(again->T_world_start.yaw, first->T_world_start.yaw);
    }
  }
}

TEST(SampleRoute, ItsGoalIsFreeOnTheDrawing) {
  const JudgeParams judge;
  const Scene scene = flat(judge);
  for (const char* name : {"CG", "CL", "HL"}) {
    const Drawing drawing = draw(find_task(name), scene.map, nullptr, 0.5, 3, 0.18);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const auto route = sample_route(scene, drawing, judge, seed);
      ASSERT_TRUE(route);
      const CoarseMap& map = drawing.map();
      EXPECT_TRUE(map.is_free(map.cell_of(drawing.world_to_map(route->goal_world))));
    }
  }
}

TEST(JudgedEpisode, TheWayMayCountAsCommanded) {
  Setting setting;
  setting.task = "CG";  // without a guard
  setting.method = "rnd";
  setting.max_actions = 80;
  const Scene scene = corridor();
  const EpisodeRow driven = run(scene, along(0.0), setting);
  setting.judge.counts_commanded_way = true;
  const EpisodeRow commanded = run(scene, along(0.0), setting);
  ASSERT_GT(driven.collisions, 0);
  EXPECT_EQ(commanded.collisions, driven.collisions);
  const double steps = commanded.driven_m / 0.15;
  EXPECT_NEAR(steps, std::round(steps), 1e-9);
  EXPECT_GT(commanded.driven_m, driven.driven_m);
}

TEST(JudgedEpisode, ThePapersRobotSlidesUnlessToldNotTo) {
  // At 45 degrees into the wall: who slides comes on along it.
  const Scene scene = corridor();
  Setting setting;
  setting.task = "CG";
  setting.method = "cmn";
  setting.max_actions = 60;
  const EpisodeRow sliding = run(scene, along(kPi / 4.0), setting);
  setting.judge.papers_robot_slides = false;
  const EpisodeRow stopping = run(scene, along(kPi / 4.0), setting);
  EXPECT_GT(sliding.driven_m, stopping.driven_m);
}

/// Grey wherever it looks, over a LiDAR in the plane.
class GreyCamera : public PlanarSensors {
 public:
  using PlanarSensors::PlanarSensors;
  ColorImage color(const Pose2& /*T_world_robot*/, double stamp_s) override {
    const CameraModel camera = CameraModel::from_field_of_view(80, 80, kPi / 2.0);
    return {stamp_s, camera, camera_mount(0.1, 0.5, 0.0),
            cv::Mat(camera.height, camera.width, CV_8UC3, cv::Scalar{9, 9, 9})};
  }
};

TEST(JudgedEpisode, ThePapersRobotIsToldItsHeadingHoweverOftenItLooksRound) {
  Scene scene = corridor();
  scene.sensors = [&scene](const LidarParams& lidar, std::uint32_t seed) {
    return std::make_unique<GreyCamera>(scene.world, lidar, seed);
  };
  Setting setting;
  setting.task = "CI";
  setting.method = "ours";
  setting.max_actions = 30;
  const auto greatest_drift_rad = [&] {
    double greatest = 0.0;
    run(scene, along(0.0), setting, [&greatest](const EpisodeMoment& moment) {
      greatest = std::max(greatest,
                          std::abs(wrap_angle(moment.T_world_robot.yaw - moment.T_odom_robot.yaw)));
    });
    return greatest;
  };
  EXPECT_LT(greatest_drift_rad(), 1e-9);
  setting.judge.papers_robot_knows_heading = false;
  EXPECT_GT(greatest_drift_rad(), 0.05);
}

TEST(JudgedEpisode, WhoGoesOnAtTheGoalMayHaveToStartOver) {
  const Scene scene = flat();
  const Route route{{1.55, 1.55, 0.0}, {7.05, 4.55}, 7.0};
  Setting setting;
  setting.task = "CG";
  setting.method = "cmn";
  setting.judge.success_radius_m = 0.05;  // so that it goes on
  const auto confidence_after_arrival = [&](bool forgets) {
    setting.judge.forgets_at_goal = forgets;
    std::optional<double> confidence;
    bool has_arrived = false;
    run(scene, route, setting, [&](const EpisodeMoment& moment) {
      if (has_arrived && !confidence) {
        confidence = moment.localization.confidence;
      }
      has_arrived = moment.decision.state == NavigationState::kReached;
    });
    return confidence;
  };
  const auto kept = confidence_after_arrival(false);
  const auto started_over = confidence_after_arrival(true);
  ASSERT_TRUE(kept && started_over);
  EXPECT_LT(*started_over, 0.5 * *kept);
}

}  // namespace
}  // namespace cmn
