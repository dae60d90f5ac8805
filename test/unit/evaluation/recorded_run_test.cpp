// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/recorded_run.hpp"

#include "coarse_map_nav/mapping/turned_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "wanderer.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cmn {
namespace {

using testing::HasSubstr;

/// Errors at every 5 m.
RecordedRun run_with(const std::vector<double>& errors_m, const std::string& building = "hall",
                     const std::string& method = "ours") {
  RecordedRun run;
  run.building = building;
  run.method = method;
  for (std::size_t i = 0; i < errors_m.size(); ++i) {
    RecordedLook look;
    look.driven_m = 5.0 * static_cast<double>(i);
    look.error_m = errors_m[i];
    run.looks.push_back(look);
  }
  return run;
}

/// A robot with a scanner over 180 degrees wanders about the flat; the log's axes are others.
CarmenLog log_of_a_walk(double length_m, const Pose2& T_log_world) {
  const World world{flat()};
  LidarParams lidar;
  lidar.field_of_view_deg = 180.0;
  lidar.beams = 181;
  RangeSensor sensor{lidar, 3};
  Wanderer robot{3};
  CarmenLog log;
  double driven_m = 0.0;
  while (driven_m < length_m) {
    const Point2 before = robot.T_world_robot.position();
    log.poses.push_back(
        {0.1 * static_cast<double>(log.poses.size()), T_log_world * robot.T_world_robot});
    log.scans.push_back(
        {log.poses.size() - 1, sensor.measure(world, robot.T_world_robot, 0.0).ranges_m});
    robot.step();
    driven_m += norm(robot.T_world_robot.position() - before);
  }
  return log;
}

NavigatorParams whole_range_params() {
  NavigatorParams params;
  params.localization.filter = "scaled";
  params.perception.local_occupancy = {160, 16.0, 0.0};
  return params;
}

TEST(RecordedRun, IsFoundWhereItsEstimateStaysRight) {
  const RecordedRun run = run_with({9.0, 1.0, 9.0, 1.4, 0.5, 1.5, 0.1});
  EXPECT_EQ(run.found_m(1.5), 15.0);
  EXPECT_TRUE(run.is_right_from(15.0, 1.5));
  EXPECT_TRUE(run.is_right_from(20.0, 1.5));
  EXPECT_FALSE(run.is_right_from(12.0, 1.5));
  EXPECT_FALSE(run.is_right_from(31.0, 1.5));  // nobody looked so late
  EXPECT_EQ(run_with({0.1, 2.0}).found_m(1.5), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(RecordedRun{}.is_right_from(0.0, 1.5));
}

TEST(RecordedRun, IsNotFoundFacingAnotherWay) {
  RecordedRun run = run_with({0.1, 0.1, 0.1});
  run.looks[1].yaw_error_rad = -1.6;
  EXPECT_EQ(run.found_m(1.5), 10.0);
  run.looks[2].yaw_error_rad = 0.8;
  EXPECT_EQ(run.found_m(1.5), std::numeric_limits<double>::infinity());
}

TEST(RecordedDrive, LiesInTheWorldAndKnowsItsLength) {
  const Pose2 T_log_world{3.0, -2.0, 0.4};
  const CarmenLog log = log_of_a_walk(10.0, T_log_world);
  const RecordedDrive drive{log, inverse(T_log_world)};
  const World world{flat()};
  ASSERT_EQ(drive.truth.size(), log.poses.size());
  for (const Pose2& pose : drive.truth) {
    EXPECT_TRUE(world.is_disc_free(pose.position(), 0.1));
  }
  EXPECT_NEAR(drive.driven_m.back(), 10.0, 0.5);
}

TEST(RecordedDrive, RunsStartWhereEnoughIsLeft) {
  const RecordedDrive drive{log_of_a_walk(10.0, {}), {}};
  const auto starts = random_starts(drive, 4.0, 30, 7);
  ASSERT_EQ(starts.size(), 30U);
  EXPECT_TRUE(std::is_sorted(starts.begin(), starts.end()));
  EXPECT_LE(drive.driven_m[drive.scans[starts.back()].pose], drive.driven_m.back() - 4.0);
  EXPECT_EQ(starts, random_starts(drive, 4.0, 30, 7));
  EXPECT_NE(starts, random_starts(drive, 4.0, 30, 8));
  EXPECT_THROW(random_starts(drive, 40.0, 30, 7), std::invalid_argument);
}

TEST(RecordedDrive, IsFoundOnAStraightAndOnAnAskewDrawing) {
  const Pose2 T_log_world{3.0, -2.0, 0.4};
  const RecordedDrive drive{log_of_a_walk(25.0, T_log_world), inverse(T_log_world)};
  const RecordedRunParams params{12.0, 8.0, 1.5, {}};
  for (const double turn_deg : {0.0, 20.0}) {
    SCOPED_TRACE(std::to_string(turn_deg) + " deg");
    NavigatorParams navigator = whole_range_params();
    navigator.localization.scaled.headings = turn_deg == 0.0 ? 4 : 36;
    navigator.localization.scaled.scales = 1;
    const CoarseMap drawing = turned_map(flat(), turn_deg * kPi / 180.0);
    RecordedRun run;
    run.looks = play(drive, 0, drawing, navigator, params, 1);
    EXPECT_TRUE(run.is_right_from(params.find_m, params.within_m)) << run.found_m(params.within_m);
    EXPECT_LE(run.looks.back().driven_m, params.find_m + params.hold_m);
    EXPECT_GT(run.looks.back().driven_m, params.find_m + params.hold_m - 1.0);
    for (const RecordedLook& look : run.looks) {
      ASSERT_TRUE(std::isfinite(look.error_m));
    }
    const auto again = play(drive, 0, drawing, navigator, params, 1);
    EXPECT_EQ(again.back().error_m, run.looks.back().error_m);
  }
}

TEST(RecordedReport, CountsByBuildingAndMethod) {
  const RecordedRunParams params{10.0, 10.0, 1.5, {}};
  const std::vector<RecordedRun> runs{run_with({9.0, 9.0, 1.0, 1.0, 1.0}),
                                      run_with({9.0, 9.0, 1.0, 1.0, 2.0}),
                                      run_with({9.0, 9.0, 9.0, 1.0, 1.0}, "hall", "other"),
                                      run_with({0.0, 0.0, 0.0, 0.0, 0.0}, "office")};
  const std::string results = results_of(runs, params);
  EXPECT_THAT(results, HasSubstr("RESULT building=hall method=\"ours\" found=0.500 low=0.0"));
  EXPECT_THAT(results, HasSubstr("building=hall method=\"other\" found=0.000"));
  EXPECT_THAT(results, HasSubstr("building=office method=\"ours\" found=1.000"));
  const std::string table = table_of(runs, params);
  EXPECT_THAT(table, HasSubstr("| building | runs | ours | other |"));
  EXPECT_THAT(table, HasSubstr("| hall | 2 | 0.50 ["));
  EXPECT_THAT(table, HasSubstr("| all | 3 | 0.67 ["));
  const std::string csv = csv_of(runs, params);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_THAT(csv, HasSubstr("hall,\"ours\",0,0.000,0.000,0.000,20.000,5,1,10.000,1.000,1.000"));
  const std::string looks = looks_csv_of(runs);
  EXPECT_EQ(std::count(looks.begin(), looks.end(), '\n'), 21);
  const std::string plot = recorded_plot(runs, params);
  EXPECT_THAT(plot, HasSubstr("office"));
  EXPECT_THAT(plot, HasSubstr("</svg>"));
  EXPECT_THAT(plot, testing::Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace cmn
