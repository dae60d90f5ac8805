// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/NavigationStatus.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <yaml-cpp/yaml.h>

namespace {

namespace fs = std::filesystem;

/// Waits for real time, as the simulated clock is what is watched.
template <class Condition>
bool wait_until(double wall_s, Condition&& condition) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(wall_s);
  while (ros::ok() && ros::WallTime::now() < end && !condition()) {
    ros::spinOnce();
    ros::WallDuration(0.05).sleep();
  }
  return condition();
}

TEST(Demo, EndsAndItsSummaryAgreesWithTheRobot) {
  ros::NodeHandle nh;
  std::string out;
  ASSERT_TRUE(ros::NodeHandle("~").getParam("out", out));
  const fs::path summary_path = fs::path{out} / "summary.json";
  fs::remove_all(out);  // the journey takes longer than it takes to get here

  coarse_map_nav::NavigationStatus status;
  const auto status_sub = nh.subscribe<coarse_map_nav::NavigationStatus>(
      "status", 10, [&](const coarse_map_nav::NavigationStatusConstPtr& m) { status = *m; });
  ASSERT_TRUE(wait_until(100.0, [&] { return fs::exists(summary_path); }));

  const YAML::Node summary = YAML::LoadFile(summary_path.string());  // JSON is YAML
  const auto state = summary["state"].as<std::string>();
  EXPECT_TRUE(state == "REACHED" || state == "FAILED") << state;
  EXPECT_EQ(summary["reached"].as<bool>(), state == "REACHED");
  if (state == "REACHED") {
    EXPECT_EQ(status.state, coarse_map_nav::NavigationStatus::REACHED);
    EXPECT_EQ(summary["actions"].as<unsigned>(), status.actions);
  }
  EXPECT_EQ(summary["goal"]["name"].as<std::string>(), "kitchen_table");
  EXPECT_GT(summary["actions"].as<unsigned>(), 0U);
  EXPECT_GT(summary["driven_m"].as<double>(), 0.0);
  EXPECT_LT(summary["sim_time_s"].as<double>(), 700.0);
  EXPECT_FALSE(summary["true_distance_to_goal_m"].IsNull());
  EXPECT_GT(fs::file_size(fs::path{out} / "run.png"), 10000U);
  EXPECT_GT(fs::file_size(fs::path{out} / "run.gif"), 10000U);
  EXPECT_LT(fs::file_size(fs::path{out} / "run.gif"), 3000000U);
}

}  // namespace
