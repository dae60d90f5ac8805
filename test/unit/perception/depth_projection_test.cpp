// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/depth_projection.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "box_room.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

const CameraModel kCamera = CameraModel::from_field_of_view(320, 240, 87.0 * kPi / 180.0);
const Eigen::Isometry3d kMount = camera_mount(0.1, 0.5, 0.2);

DepthImage look_at(const std::vector<Box>& boxes) {
  return depth_of_boxes(boxes, kCamera, kMount, {});
}

/// The range at a bearing about the camera.
float range_at(const RangeScan& scan, double bearing_rad) {
  const double beam = (bearing_rad - scan.angle_min_rad) / scan.angle_increment_rad;
  return scan.ranges_m.at(static_cast<std::size_t>(std::lround(beam)));
}

RangeScan::Sight sight_at(const RangeScan& scan, double bearing_rad) {
  const double beam = (bearing_rad - scan.angle_min_rad) / scan.angle_increment_rad;
  return scan.sights.at(static_cast<std::size_t>(std::lround(beam)));
}

/// A block of 0.5 m width, 1.5 m before the robot's middle.
Box block(double from_z_m, double to_z_m) { return {{1.5, -0.25, from_z_m}, {2.0, 0.25, to_z_m}}; }

std::vector<std::uint8_t> bytes_of(const DepthImage& image, std::size_t point_step) {
  std::vector<std::uint8_t> bytes;
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) {
      const float depth = image.depth_m.at<float>(v, u);
      const float point[3]{static_cast<float>((u - image.camera.cx) / image.camera.fx) * depth,
                           static_cast<float>((v - image.camera.cy) / image.camera.fy) * depth,
                           depth};
      bytes.resize(bytes.size() + point_step);
      std::memcpy(bytes.data() + bytes.size() - point_step, point, sizeof point);
    }
  }
  return bytes;
}

TEST(DepthProjector, SeesTheNearestOfWhatStandsInTheWay) {
  DepthProjector projector{DepthParams{}};
  const RangeScan scan = projector.scan(look_at({block(0.0, 0.4)}));
  EXPECT_NEAR(range_at(scan, 0.0), 1.4, 0.01) << "from the camera";
  EXPECT_NEAR(scan.T_robot_sensor.x, 0.1, 1e-9);
  EXPECT_EQ(range_at(scan, 0.5), kInf) << "only floor";
  EXPECT_EQ(projector.report().floor, FloorSource::kSeen);
}

TEST(DepthProjector, TheEdgeOfATableCountsAndALampDoesNot) {
  DepthProjector projector{DepthParams{}};
  EXPECT_NEAR(range_at(projector.scan(look_at({block(0.70, 0.74)})), 0.0), 1.4, 0.01);
  EXPECT_EQ(range_at(projector.scan(look_at({block(0.9, 1.2)})), 0.0), kInf);
  EXPECT_EQ(range_at(projector.scan(look_at({block(0.0, 0.04)})), 0.0), kInf) << "a door sill";
}

TEST(DepthProjector, IsFreeOnlyWhereTheGroundWasSeen) {
  DepthProjector projector{DepthParams{}};
  const RangeScan scan = projector.scan(look_at({block(0.0, 0.4)}));
  const double lowest_rad = 0.2 + std::atan2(119.5, kCamera.fy);
  EXPECT_NEAR(sight_at(scan, 0.0).from_m, 0.5 / std::tan(lowest_rad), 0.02);
  EXPECT_NEAR(sight_at(scan, 0.5).to_m, 5.0, 0.15);
  // A black wall gives no readings: nothing is known beyond the floor before it.
  DepthImage dark = look_at({{{2.1, -9.0, 0.0}, {2.2, 9.0, 3.0}}});
  dark.depth_m.setTo(kNan, dark.depth_m != look_at({}).depth_m);
  const RangeScan half_seen = projector.scan(dark);
  EXPECT_EQ(range_at(half_seen, 0.0), kInf);
  EXPECT_GT(sight_at(half_seen, 0.0).to_m, 1.5);
  EXPECT_LT(sight_at(half_seen, 0.0).to_m, 2.1);
}

TEST(DepthProjector, KnowsNothingWithoutReadings) {
  DepthProjector projector{DepthParams{}};
  DepthImage image = look_at({});
  for (const float nothing : {0.0F, kNan, kInf, -kInf, -1.0F}) {
    image.depth_m.setTo(nothing);
    const RangeScan scan = projector.scan(image);
    EXPECT_TRUE(std::all_of(scan.ranges_m.begin(), scan.ranges_m.end(), [](float range) {
      return std::isnan(range);
    })) << nothing;
    EXPECT_EQ(projector.report().points, 0U);
    EXPECT_EQ(projector.report().unusable, 320U * 240U);
  }
}

TEST(DepthProjector, AWallFartherThanTheRangeLeavesItFree) {
  DepthProjector projector{DepthParams{}};
  const RangeScan scan = projector.scan(look_at({{{7.0, -9.0, 0.0}, {7.1, 9.0, 3.0}}}));
  EXPECT_EQ(range_at(scan, 0.0), kInf);
  EXPECT_NEAR(sight_at(scan, 0.0).to_m, 5.0, 0.15);
}

TEST(DepthProjector, FlyingPixelsAndNoiseAreNoObstacles) {
  // Between the edge of the block and the wall behind it, two columns of each row lie anywhere.
  DepthImage image = look_at({block(0.0, 1.0), {{4.0, -9.0, 0.0}, {4.1, 9.0, 3.0}}});
  std::mt19937 rng{4};
  std::uniform_real_distribution<float> anywhere{0.0F, 1.0F};
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 3; u + 3 < image.camera.width; ++u) {
      float* row = image.depth_m.ptr<float>(v);
      if (std::abs(row[u - 1] - row[u + 1]) > 1.0F) {
        row[u] = row[u - 1] + anywhere(rng) * (row[u + 1] - row[u - 1]);
        ++u;
      }
    }
    image.depth_m.at<float>(v, static_cast<int>(anywhere(rng) * 319.0F)) = 5.0F * anywhere(rng);
  }
  DepthProjector projector{DepthParams{}};
  const RangeScan scan = projector.scan(image);
  EXPECT_GT(projector.report().flying, 100U);
  EXPECT_GT(projector.report().isolated, 10U);
  int false_hits = 0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double bearing = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    const bool is_block = std::abs(1.4 * std::tan(bearing)) < 0.25 + 0.03;
    const double true_m = is_block ? 1.4 / std::cos(bearing) : 3.9 / std::cos(bearing);
    false_hits += static_cast<double>(scan.ranges_m[i]) < 0.9 * true_m;
  }
  EXPECT_EQ(false_hits, 0);
}

TEST(DepthProjector, StripesWithoutLightLeaveTheRestAlone) {
  DepthImage image = look_at({block(0.0, 0.4)});
  for (int v = 0; v < image.camera.height; v += 8) {
    image.depth_m.rowRange(v, v + 4).setTo(0.0F);
  }
  image.depth_m.colRange(0, 70).setTo(kNan);
  DepthProjector projector{DepthParams{}};
  const RangeScan scan = projector.scan(image);
  EXPECT_NEAR(range_at(scan, 0.0), 1.4, 0.02);
  EXPECT_TRUE(std::isnan(range_at(scan, 0.65))) << "behind the stripe of columns";
}

TEST(DepthProjector, ACloudBecomesTheSameAsItsImage) {
  const DepthImage image = look_at(furnished_room());
  DepthProjector projector{DepthParams{}};
  const RangeScan of_image = projector.scan(image);
  for (const std::size_t point_step : {std::size_t{12}, std::size_t{32}}) {
    const std::vector<std::uint8_t> bytes = bytes_of(image, point_step);
    PointCloudView cloud{0.0,        bytes.data(), 320,        240,   point_step, 320 * point_step,
                         {0, false}, {4, false},   {8, false}, kMount};
    const RangeScan organised = projector.scan(cloud);
    for (double bearing = -0.7; bearing < 0.7; bearing += 0.01) {
      EXPECT_NEAR(range_at(organised, bearing), range_at(of_image, bearing), 0.05) << bearing;
    }
    cloud.height = 1;
    cloud.width = 320 * 240;
    cloud.row_step = cloud.width * point_step;
    const RangeScan loose = projector.scan(cloud);
    EXPECT_EQ(loose.ranges_m.size(), organised.ranges_m.size());
    EXPECT_NEAR(range_at(loose, 0.0), range_at(of_image, 0.0), 0.05);
  }
}

TEST(DepthProjector, ACloudAllAroundHasNoSeam) {
  std::vector<float> points;
  for (double bearing = -kPi; bearing < kPi; bearing += 0.002) {
    for (float z = -0.3F; z < 0.3F; z += 0.02F) {
      points.push_back(static_cast<float>(2.0 * std::cos(bearing)));
      points.push_back(static_cast<float>(2.0 * std::sin(bearing)));
      points.push_back(z);
    }
  }
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.translation().z() = 0.4;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(points.data());
  const PointCloudView cloud{0.0,        bytes,      points.size() / 3, 1,    12, points.size() * 4,
                             {0, false}, {4, false}, {8, false},        mount};
  const RangeScan scan = DepthProjector{DepthParams{}}.scan(cloud);
  for (const float range : scan.ranges_m) {
    EXPECT_NEAR(range, 2.0F, 0.01F);
  }
}

TEST(DepthProjector, LooksThatFaceTheFloorOrTheCeilingAreNoTrouble) {
  DepthProjector projector{DepthParams{}};
  for (const double pitch : {-kPi / 2.0, -1.2, -0.5, 0.5, 1.2, kPi / 2.0}) {
    SCOPED_TRACE(pitch);
    const DepthImage image =
        depth_of_boxes(furnished_room(), kCamera, camera_mount(0.0, 0.5, pitch), {});
    const RangeScan scan = projector.scan(image);
    EXPECT_EQ(scan.ranges_m.size(), scan.sights.size());
    EXPECT_LE(scan.angle_increment_rad * static_cast<double>(scan.ranges_m.size()),
              2.0 * kPi + 1e-9);
  }
}

}  // namespace
}  // namespace cmn
