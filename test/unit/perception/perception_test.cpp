// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/perception.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "box_room.hpp"
#include "fake_predictor.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

PerceptionParams params_of(const std::string& source, const std::string& accumulate = "none") {
  PerceptionParams params;
  params.source = source;
  params.accumulate = accumulate;
  params.local_occupancy = {60, 6.0, 0.0};
  params.local_map = {60, 6.0, 0.0};
  params.guard.type = "footprint";
  return params;
}

/// A table 1 m ahead, of which a LiDAR at 0.3 m sees nothing.
const std::vector<Box> kTable{{{1.0, -0.6, 0.70}, {1.8, 0.6, 0.74}}};

DepthImage depth_of(const std::vector<Box>& boxes) {
  return depth_of_boxes(boxes, CameraModel::from_field_of_view(160, 120, 87.0 * kPi / 180.0),
                        camera_mount(0.1, 0.5, 0.2), {});
}

float occupancy_at(const LocalOccupancy& seen, double x, double y) {
  return seen
      .occupancy[seen.index_of(static_cast<int>(std::floor(x / seen.resolution)) + seen.size / 2,
                               static_cast<int>(std::floor(y / seen.resolution)) + seen.size / 2)];
}
float confidence_at(const LocalOccupancy& seen, double x, double y) {
  return seen
      .confidence[seen.index_of(static_cast<int>(std::floor(x / seen.resolution)) + seen.size / 2,
                                static_cast<int>(std::floor(y / seen.resolution)) + seen.size / 2)];
}

TEST(Perception, ADepthCameraSeesTheTableThatALidarLooksBelow) {
  const RangeScan scan = scan_of_boxes(kTable, 0.3, 360, {});
  const DepthImage image = depth_of(kTable);
  const Percept lidar = Perception{params_of("lidar")}.look({&scan}, {}, true);
  EXPECT_EQ(occupancy_at(lidar.seen, 1.05, 0.0), 0.0F);
  EXPECT_EQ(lidar.clear_ahead_m, kInf);
  const Percept depth = Perception{params_of("depth")}.look({nullptr, &image}, {}, true);
  EXPECT_EQ(occupancy_at(depth.seen, 1.05, 0.0), 1.0F);
  EXPECT_EQ(depth.seen.source, ObservationSource::kDepth);
  EXPECT_NEAR(depth.clear_ahead_m, 1.0 - 0.17, 0.05);
  EXPECT_EQ(confidence_at(depth.seen, -1.0, 0.0), 0.0F) << "behind it";
}

TEST(Perception, FusedTheNearestObstacleWinsAndTheLidarAloneGuards) {
  const RangeScan scan = scan_of_boxes(kTable, 0.3, 360, {});
  const DepthImage image = depth_of(kTable);
  const Percept fused = Perception{params_of("fused")}.look({&scan, &image}, {}, true);
  EXPECT_EQ(fused.seen.source, ObservationSource::kFused);
  EXPECT_EQ(occupancy_at(fused.seen, 1.05, 0.0), 1.0F) << "the table";
  EXPECT_EQ(confidence_at(fused.seen, 1.55, 0.0), 0.0F) << "what is under it is not seen";
  EXPECT_EQ(confidence_at(fused.seen, -1.0, 0.0), kPresumed) << "behind it looks the LiDAR";
  EXPECT_EQ(confidence_at(fused.seen, 0.35, 0.0), kPresumed)
      << "and where it is too near for the camera";
  EXPECT_EQ(occupancy_at(fused.local_map, 1.05, 0.0), 1.0F);
  EXPECT_EQ(fused.clear_ahead_m, kInf);
}

TEST(Perception, TheGroundTooNearForACameraIsOnlyPresumedFreeAndMemoryOutweighsIt) {
  Perception perception{params_of("depth", "rolling")};
  const std::vector<Box> block{{{1.5, -0.2, 0.0}, {1.7, 0.2, 0.15}}};
  Percept percept;
  for (double x = 0.0; x < 1.25; x += 0.1) {
    const DepthImage image =
        depth_of_boxes(block, CameraModel::from_field_of_view(160, 120, 87.0 * kPi / 180.0),
                       camera_mount(0.1, 0.5, 0.2), {x, 0.0, 0.0});
    percept = perception.look({nullptr, &image}, {x, 0.0, 0.0}, false);
  }
  // 0.3 m ahead the low block is below the view.
  EXPECT_EQ(confidence_at(Perception{params_of("depth")}
                              .look({nullptr,
                                     [] {
                                       static const DepthImage kImage = depth_of({});
                                       return &kImage;
                                     }()},
                                    {}, false)
                              .seen,
                          0.35, 0.0),
            kPresumed);
  EXPECT_GT(occupancy_at(percept.seen, 0.35, 0.0), 0.5F);
}

TEST(Perception, ABlindCameraAllowsNoStep) {
  DepthImage image = depth_of({});
  image.depth_m.setTo(0.0F);
  Perception perception{params_of("depth")};
  EXPECT_EQ(perception.look({nullptr, &image}, {}, false).clear_ahead_m, 0.0);
  EXPECT_EQ(perception.clear_ahead_m({nullptr, &image}), 0.0);
  const DepthImage free = depth_of({});
  EXPECT_EQ(perception.clear_ahead_m({nullptr, &free}), kInf);
}

TEST(Perception, APanoramaIsPartialUntilAllFourLooksAreThere) {
  Perception perception{params_of("depth", "panorama")};
  const DepthImage image = depth_of(kTable);
  for (int turn = 0; turn < 5; ++turn) {
    const Percept percept = perception.look({nullptr, &image}, {0.0, 0.0, turn * kPi / 2.0}, true);
    EXPECT_EQ(percept.is_complete, turn == 4);
  }
  perception.forget();
  EXPECT_FALSE(perception.look({nullptr, &image}, {}, true).is_complete);
}

TEST(Perception, ALidarThatSeesOverATableDoesNotMakeTheRobotForgetIt) {
  PerceptionParams params = params_of("fused", "rolling");
  Perception perception{params};
  const RangeScan scan = scan_of_boxes(kTable, 0.3, 360, {});
  const DepthImage image = depth_of(kTable);
  EXPECT_EQ(occupancy_at(perception.look({&scan, &image}, {}, true).local_map, 1.05, 0.0), 1.0F);
  // Turned away from the table, and past its edge as far as the LiDAR can tell.
  const DepthImage nothing = depth_of({});
  Percept percept;
  for (int look = 0; look < 4; ++look) {
    percept = perception.look({&scan, &nothing}, {0.0, 0.0, kPi / 2.0}, true);
  }
  EXPECT_GT(occupancy_at(percept.local_map, 0.0, -1.05), 0.5F);
}

TEST(Perception, ThePlannerMayRememberWhatThePanoramaOfTheNextStopLacks) {
  PerceptionParams params = params_of("depth", "panorama");
  const DepthImage table = depth_of(kTable);
  DepthImage nothing = table;
  nothing.depth_m = cv::Mat{table.depth_m.size(), CV_32FC1, cv::Scalar{0.0}};
  for (const std::string word : {"same", "rolling"}) {
    SCOPED_TRACE(word);
    params.accumulate_local_map = word;
    Perception perception{params};
    const Percept there = perception.look({nullptr, &table}, {}, true);
    ASSERT_EQ(occupancy_at(there.local_map, 1.05, 0.0), 1.0F);
    const Percept next = perception.look({nullptr, &nothing}, {0.2, 0.0, 0.0}, true);
    EXPECT_EQ(confidence_at(next.seen, 0.85, 0.0), 0.0F);
    EXPECT_EQ(confidence_at(next.local_map, 0.85, 0.0) > 0.0F, word == "rolling");
  }
}

TEST(Perception, TellsOfTheDriftOfTheHeadingWhereItAlignsLooks) {
  PerceptionParams params = params_of("depth", "panorama");
  const DepthImage image = depth_of(kTable);
  const auto drift_of = [&](bool with_local_map) {
    return Perception{params}
        .look({nullptr, &image}, {}, with_local_map)
        .seen.heading_drift.has_value();
  };
  EXPECT_FALSE(drift_of(true)) << "a panorama alone is laid as odometry says";
  params.accumulate_local_map = "rolling";
  EXPECT_TRUE(drift_of(true));
  EXPECT_FALSE(drift_of(false));
  params.rolling.align.enabled = false;
  EXPECT_FALSE(drift_of(true));
  params.rolling.align.enabled = true;
  params.accumulate = "rolling";
  EXPECT_TRUE(drift_of(false));
}

TEST(Perception, AnUnknownAccumulatorIsRefused) {
  EXPECT_THROW(Perception{params_of("lidar", "hoarding")}, std::invalid_argument);
}

ColorImage color_image(int red, double stamp_s = 5.0) {
  const CameraModel camera = CameraModel::from_field_of_view(160, 120, kPi / 2.0);
  return {stamp_s, camera, camera_mount(0.1, 0.5, 0.0),
          cv::Mat(camera.height, camera.width, CV_8UC3, cv::Scalar{0, 0, red * 1.0})};
}

TEST(Perception, RgbTurnsRoundPredictsOnceItIsRoundAndTheLidarGuards) {
  const auto predictor = std::make_shared<FakePredictor>();
  Perception perception{params_of("rgb", "panorama"), predictor};
  const RangeScan scan = scan_of_boxes({{{1.5, -9.0, 0.0}, {1.6, 9.0, 2.0}}}, 0.3, 360, {});
  const ColorImage image = color_image(8);
  SensorData data{&scan};
  data.color = &image;
  Percept percept;
  for (int turn = 0; turn < 5; ++turn) {
    percept = perception.look(data, {0.0, 0.0, turn * kPi / 2.0}, true);
    EXPECT_EQ(percept.is_complete, turn == 4) << turn;
    EXPECT_EQ(percept.seen.stamp_s, 5.0);
    EXPECT_NEAR(percept.clear_ahead_m, 1.5 - 0.17, 0.05);
  }
  EXPECT_EQ(predictor->predictions, 1);
  EXPECT_EQ(percept.seen.source, ObservationSource::kRgb);
  for (const LocalOccupancy& seen : {percept.seen, percept.local_map}) {
    EXPECT_EQ(occupancy_at(seen, -0.45, 0.05), 0.0F);
    EXPECT_EQ(occupancy_at(seen, 0.05, 0.85), 1.0F);
    EXPECT_EQ(confidence_at(seen, 0.85, 0.05), 1.0F);
    EXPECT_EQ(confidence_at(seen, 1.25, 0.05), 0.0F) << "behind it";
  }
}

TEST(Perception, WhatTheLocalizerIsToldGrowsWhatThePlannerIsToldDoesNot) {
  const RangeScan scan = scan_of_boxes({{{1.5, -9.0, 0.0}, {1.6, 9.0, 2.0}}}, 0.3, 360, {});
  PerceptionParams params = params_of("lidar");
  params.grow_m = 0.3;
  const Percept percept = Perception{params}.look({&scan}, {}, true);
  EXPECT_EQ(percept.seen.size, params.local_occupancy.size);
  EXPECT_EQ(occupancy_at(percept.seen, 1.25, 0.05), 1.0F);
  EXPECT_EQ(occupancy_at(percept.seen, 1.05, 0.05), 0.0F);
  EXPECT_EQ(occupancy_at(percept.local_map, 1.25, 0.05), 0.0F);
  EXPECT_NEAR(percept.clear_ahead_m, 1.5 - 0.17, 0.05);
}

TEST(Perception, RgbWithAMemoryKeepsWhatItSawBeforeItTurned) {
  Perception perception{params_of("rgb", "rolling"), std::make_shared<FakePredictor>()};
  const RangeScan scan = scan_of_boxes({}, 0.3, 360, {});
  const ColorImage image = color_image(30);
  SensorData data{&scan};
  data.color = &image;
  Percept percept = perception.look(data, {}, false);
  EXPECT_TRUE(percept.is_complete);
  EXPECT_EQ(confidence_at(percept.seen, 0.05, 0.95), 0.0F);
  percept = perception.look(data, {0.0, 0.0, kPi / 2.0}, false);
  EXPECT_EQ(occupancy_at(percept.seen, 0.95, 0.05), 0.0F) << "ahead";
  EXPECT_EQ(occupancy_at(percept.seen, 0.05, -0.95), 0.0F) << "seen before";
  EXPECT_EQ(confidence_at(percept.seen, -0.95, 0.05), 0.0F);
  perception.forget();
  percept = perception.look(data, {}, false);
  EXPECT_EQ(confidence_at(percept.seen, 0.05, -0.95), 0.0F);
}

TEST(Perception, RgbWithoutANetworkIsRefused) {
  EXPECT_THROW(Perception{params_of("rgb")}, std::invalid_argument);
}

}  // namespace
}  // namespace cmn
