// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/ros/conversions.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfF = std::numeric_limits<float>::infinity();

/// A way to spoil a good message.
template <class Message>
struct Fault {
  const char* name;
  std::function<void(Message&)> spoil;
};

// ---- Poses ---------------------------------------------------------------------------------

TEST(PoseConversion, RoundTripKeepsPositionAndYaw) {
  std::mt19937 rng{1};
  std::uniform_real_distribution<double> metres{-100.0, 100.0};
  std::uniform_real_distribution<double> yaw{-kPi, kPi};
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const Pose2 pose{metres(rng), metres(rng), yaw(rng)};
    for (const auto& back : {pose_of(pose_message(pose)), pose_of(transform_message(pose))}) {
      ASSERT_TRUE(back);
      EXPECT_NEAR(back->x, pose.x, 1e-12);
      EXPECT_NEAR(back->y, pose.y, 1e-12);
      EXPECT_NEAR(wrap_angle(back->yaw - pose.yaw), 0.0, 1e-12);
    }
  }
}

TEST(PoseConversion, QuaternionNeedNotBeNormalised) {
  geometry_msgs::Quaternion q = quaternion_of(1.2);
  for (double* part : {&q.x, &q.y, &q.z, &q.w}) {
    *part *= 7.0;
  }
  ASSERT_TRUE(yaw_of(q));
  EXPECT_NEAR(*yaw_of(q), 1.2, 1e-12);
}

TEST(PoseConversion, WhatIsNoRotationOrNoPointIsRefused) {
  EXPECT_FALSE(yaw_of(geometry_msgs::Quaternion{})) << "all zero, as in a message nobody filled in";
  for (const double bad : {kNan, kInf, -kInf}) {
    SCOPED_TRACE(bad);
    geometry_msgs::Quaternion q = quaternion_of(0.0);
    q.y = bad;
    EXPECT_FALSE(yaw_of(q));
    geometry_msgs::Pose pose = pose_message({});
    pose.position.y = bad;
    EXPECT_FALSE(pose_of(pose));
    geometry_msgs::Transform transform = transform_message({});
    transform.translation.x = bad;
    EXPECT_FALSE(pose_of(transform));
  }
}

// ---- Maps ----------------------------------------------------------------------------------

CoarseMap room() {
  return ascii_map({"#####",  //
                    "#...#",  //
                    "#.#.#",  //
                    "#####"},
                   0.4, {1.0, -2.0, 0.3});
}

TEST(MapConversion, RoundTripKeepsCellsResolutionAndOrigin) {
  std::string why;
  const auto back = map_of(grid_message(room()), why);
  ASSERT_TRUE(back) << why;
  EXPECT_TRUE(back->occupied() == room().occupied());
  EXPECT_EQ(back->resolution(), 0.4) << "not 0.4F";
  EXPECT_NEAR(back->T_map_grid().x, 1.0, 1e-12);
  EXPECT_NEAR(back->T_map_grid().yaw, 0.3, 1e-12);
}

TEST(MapConversion, UnknownCellsAreOccupied) {
  nav_msgs::OccupancyGrid grid = grid_message(room());
  grid.data[6] = -1;
  grid.data[8] = 49;
  std::string why;
  const auto map = map_of(grid, why);
  ASSERT_TRUE(map) << why;
  EXPECT_TRUE(map->is_occupied({1, 1}));
  EXPECT_TRUE(map->is_free({3, 1}));
}

TEST(MapConversion, MalformedMapsAreRefusedWithAReason) {
  using Grid = nav_msgs::OccupancyGrid;
  const Fault<Grid> faults[]{
      {"no data", [](Grid& g) { g.data.clear(); }},
      {"one cell short", [](Grid& g) { g.data.pop_back(); }},
      {"no width", [](Grid& g) { g.info.width = 0; }},
      {"huge", [](Grid& g) { g.info.width = g.info.height = 4294967295U; }},
      {"resolution 0", [](Grid& g) { g.info.resolution = 0.0F; }},
      {"resolution too small to divide by", [](Grid& g) { g.info.resolution = 1e-9F; }},
      {"resolution < 0", [](Grid& g) { g.info.resolution = -0.4F; }},
      {"resolution NaN", [](Grid& g) { g.info.resolution = kNanF; }},
      {"resolution inf", [](Grid& g) { g.info.resolution = kInfF; }},
      {"origin NaN", [](Grid& g) { g.info.origin.position.x = kNan; }},
      {"origin without orientation", [](Grid& g) { g.info.origin.orientation = {}; }},
      {"all occupied", [](Grid& g) { g.data.assign(g.data.size(), 100); }},
      {"all unknown", [](Grid& g) { g.data.assign(g.data.size(), -1); }},
  };
  for (const auto& fault : faults) {
    SCOPED_TRACE(fault.name);
    Grid grid = grid_message(room());
    fault.spoil(grid);
    std::string why;
    EXPECT_FALSE(map_of(grid, why));
    EXPECT_FALSE(why.empty());
  }
}

// ---- Local occupancy -----------------------------------------------------------------------

LocalOccupancy some_occupancy() {
  LocalOccupancy local{5, 0.05};
  local.stamp_s = 12.5;
  local.source = ObservationSource::kLidar;
  for (std::size_t i = 0; i < local.cell_count(); ++i) {
    local.occupancy[i] = static_cast<float>(i) / 25.0F;
    local.confidence[i] = static_cast<float>(i % 3);
  }
  return local;
}

coarse_map_nav::LocalOccupancy occupancy_message() {
  std_msgs::Header header;
  header.stamp = ros::Time{12.5};
  return message_of(some_occupancy(), header);
}

TEST(LocalOccupancyConversion, RoundTripKeepsEverything) {
  std::string why;
  const auto back = local_occupancy_of(occupancy_message(), why);
  ASSERT_TRUE(back) << why;
  EXPECT_EQ(back->stamp_s, 12.5);
  EXPECT_EQ(back->resolution, 0.05);
  EXPECT_EQ(back->size, 5);
  EXPECT_EQ(back->occupancy, some_occupancy().occupancy);
  EXPECT_EQ(back->confidence, some_occupancy().confidence);
  EXPECT_EQ(back->source, ObservationSource::kLidar);
  EXPECT_FALSE(back->heading_drift);
  LocalOccupancy aligned = some_occupancy();
  aligned.heading_drift = HeadingDrift{-0.25, 3.5};
  const auto drift = local_occupancy_of(message_of(aligned, {}), why)->heading_drift;
  ASSERT_TRUE(drift);
  EXPECT_EQ(drift->rad, -0.25);
  EXPECT_EQ(drift->since_s, 3.5);
}

TEST(LocalOccupancyConversion, APictureShowsTheMiddleSixMetres) {
  LocalOccupancy local{160, 0.1};
  local.occupancy[local.index_of(50, 51)] = 1.0F;
  local.confidence[local.index_of(50, 51)] = 1.0F;
  const nav_msgs::OccupancyGrid grid = grid_message(local, {});
  ASSERT_EQ(grid.info.width, 60U);
  ASSERT_EQ(grid.data.size(), 3600U);
  EXPECT_DOUBLE_EQ(grid.info.origin.position.x, -3.0);
  EXPECT_EQ(grid.data[60], 100);
  EXPECT_EQ(grid.data[0], -1);
  EXPECT_EQ(grid_message(LocalOccupancy{128, 0.01}, {}).info.width, 128U);
}

TEST(LocalOccupancyConversion, MalformedOnesAreRefusedWithAReason) {
  using Local = coarse_map_nav::LocalOccupancy;
  const Fault<Local> faults[]{
      {"empty", [](Local& m) { m = Local{}; }},
      {"one value short", [](Local& m) { m.occupancy.pop_back(); }},
      {"one confidence more", [](Local& m) { m.confidence.push_back(1.0F); }},
      {"size that overflows 32 bits squared", [](Local& m) { m.size = 65536; }},
      {"resolution 0", [](Local& m) { m.resolution = 0.0F; }},
      {"resolution too small to divide by", [](Local& m) { m.resolution = 1e-9F; }},
      {"resolution NaN", [](Local& m) { m.resolution = kNanF; }},
      {"occupancy NaN", [](Local& m) { m.occupancy[3] = kNanF; }},
      {"occupancy > 1", [](Local& m) { m.occupancy[3] = 1.01F; }},
      {"occupancy < 0", [](Local& m) { m.occupancy[3] = -0.01F; }},
      {"confidence NaN", [](Local& m) { m.confidence[3] = kNanF; }},
      {"confidence < 0", [](Local& m) { m.confidence[3] = -1.0F; }},
      {"confidence inf", [](Local& m) { m.confidence[3] = kInfF; }},
      {"heading drift NaN", [](Local& m) { m.heading_drift = kNanF; }},
  };
  for (const auto& fault : faults) {
    SCOPED_TRACE(fault.name);
    Local message = occupancy_message();
    fault.spoil(message);
    std::string why;
    EXPECT_FALSE(local_occupancy_of(message, why));
    EXPECT_FALSE(why.empty());
  }
}

// ---- Scans ---------------------------------------------------------------------------------

sensor_msgs::LaserScan some_scan() {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = ros::Time{3.25};
  scan.angle_min = -1.0F;
  scan.angle_max = 1.0F;
  scan.angle_increment = 0.5F;
  scan.range_min = 0.1F;
  scan.range_max = 8.0F;
  scan.ranges = {1.0F, kNanF, kInfF, -2.0F, 0.0F};
  return scan;
}

TEST(ScanConversion, BadSingleRangesAreNoFaultOfTheScan) {
  EXPECT_EQ(fault_of(some_scan()), "");
  const RangeScan scan = scan_of(some_scan(), {0.1, 0.2, 0.3});
  EXPECT_EQ(scan.stamp_s, 3.25);
  EXPECT_EQ(scan.angle_min_rad, -1.0);
  EXPECT_EQ(scan.angle_increment_rad, 0.5);
  EXPECT_EQ(scan.ranges_m.size(), 5U);
  EXPECT_EQ(scan.T_robot_sensor.y, 0.2);
}

TEST(ScanConversion, ClockwiseSensorsAreTaken) {
  sensor_msgs::LaserScan scan = some_scan();
  scan.angle_increment = -0.5F;
  EXPECT_EQ(fault_of(scan), "");
}

TEST(ScanConversion, MalformedScansAreRefusedWithAReason) {
  using Scan = sensor_msgs::LaserScan;
  const Fault<Scan> faults[]{
      {"no ranges", [](Scan& s) { s.ranges.clear(); }},
      {"angle NaN", [](Scan& s) { s.angle_min = kNanF; }},
      {"increment 0", [](Scan& s) { s.angle_increment = 0.0F; }},
      {"increment NaN", [](Scan& s) { s.angle_increment = kNanF; }},
      {"increment inf", [](Scan& s) { s.angle_increment = kInfF; }},
      {"increment that no beam number could count", [](Scan& s) { s.angle_increment = 1e-30F; }},
      {"range_min NaN", [](Scan& s) { s.range_min = kNanF; }},
      {"range_max NaN", [](Scan& s) { s.range_max = kNanF; }},
      {"empty interval", [](Scan& s) { s.range_max = s.range_min; }},
      {"range_min < 0", [](Scan& s) { s.range_min = -0.1F; }},
  };
  for (const auto& fault : faults) {
    SCOPED_TRACE(fault.name);
    Scan scan = some_scan();
    fault.spoil(scan);
    EXPECT_NE(fault_of(scan), "");
  }
}

// ---- Beliefs -------------------------------------------------------------------------------

coarse_map_nav::Belief belief_message() {
  Belief belief{5, 4};
  belief.set_weight(Heading::kNorth, {3, 1}, 3.0);
  belief.set_weight(Heading::kWest, {1, 2}, 1.0);
  EXPECT_TRUE(belief.normalise());
  return message_of({belief,
                     {Heading::kNorth, {3, 1}, 0.75},
                     {3.9, 0.8},
                     kPi / 2.0 + 0.2,
                     0.875,
                     true,
                     0.75,
                     -0.5},
                    room());
}

TEST(BeliefConversion, RoundTripKeepsProbabilitiesAndEstimate) {
  std::string why;
  const auto back = belief_of(belief_message(), room(), why);
  ASSERT_TRUE(back) << why;
  EXPECT_NEAR(back->belief(Heading::kNorth, {3, 1}), 0.75, 1e-7);
  EXPECT_NEAR(back->belief(Heading::kWest, {1, 2}), 0.25, 1e-7);
  EXPECT_EQ(back->belief(Heading::kEast, {1, 2}), 0.0);
  EXPECT_EQ(back->estimate.cell, (Cell{3, 1})) << "although the finer position is beside it";
  EXPECT_EQ(back->estimate.heading, Heading::kNorth);
  EXPECT_NEAR(back->estimate.probability, 0.75, 1e-7);
  EXPECT_NEAR(back->position_cells.x, 3.9, 1e-12);
  EXPECT_NEAR(back->position_cells.y, 0.8, 1e-12);
  EXPECT_NEAR(back->yaw_rad, kPi / 2.0 + 0.2, 1e-12);
  EXPECT_EQ(back->confidence, 0.875);
  EXPECT_TRUE(back->is_converged);
  EXPECT_EQ(back->scale, 0.75);
  EXPECT_EQ(back->axes_yaw_rad, -0.5);
}

TEST(BeliefConversion, MalformedBeliefsAreRefusedWithAReason) {
  using Message = coarse_map_nav::Belief;
  const Fault<Message> faults[]{
      {"empty", [](Message& m) { m = Message{}; }},
      {"of another map", [](Message& m) { m.info.width = 6; }},
      {"of one heading", [](Message& m) { m.layers = 1; }},
      {"one value short", [](Message& m) { m.probability.pop_back(); }},
      {"all zero", [](Message& m) { m.probability.assign(m.probability.size(), 0.0F); }},
      {"NaN", [](Message& m) { m.probability[7] = kNanF; }},
      {"inf", [](Message& m) { m.probability[7] = kInfF; }},
      {"negative", [](Message& m) { m.probability[7] = -0.1F; }},
      {"estimate NaN", [](Message& m) { m.estimate.position.x = kNan; }},
      {"estimate without orientation", [](Message& m) { m.estimate.orientation = {}; }},
      {"estimate off the map", [](Message& m) { m.estimate.position.x = -100.0; }},
      {"estimate far off the map", [](Message& m) { m.estimate.position.x = 1e30; }},
      {"most probable state beyond all", [](Message& m) { m.most_probable = 80; }},
      {"confidence NaN", [](Message& m) { m.confidence = kNanF; }},
      {"scale 0", [](Message& m) { m.scale = 0.0F; }},
      {"axes inf", [](Message& m) { m.axes_yaw = kInfF; }},
  };
  for (const auto& fault : faults) {
    SCOPED_TRACE(fault.name);
    Message message = belief_message();
    fault.spoil(message);
    std::string why;
    EXPECT_FALSE(belief_of(message, room(), why));
    EXPECT_FALSE(why.empty());
  }
}

}  // namespace
}  // namespace cmn
