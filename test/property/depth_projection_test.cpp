// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A depth camera in rooms of boxes sees what a LiDAR would that saw at all heights.
#include "coarse_map_nav/perception/depth_projection.hpp"

#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/perception/panorama.hpp"

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "box_room.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

const CameraModel kCamera = CameraModel::from_field_of_view(320, 240, kPi / 2.0);
constexpr double kHeight_m = 0.5;
constexpr double kPitch_rad = 0.15;
const ProjectionParams kGrid{48, 4.8, 0.0};

/// Four walls and some boxes that stand on the floor, none nearer to the origin than 0.9 m, all
/// higher than a LiDAR and the camera.
std::vector<Box> room(std::mt19937_64& rng) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * draw_uniform(rng);
  };
  const double east = between(1.8, 3.0), north = between(1.8, 3.0);
  const double west = -between(1.8, 3.0), south = -between(1.8, 3.0);
  std::vector<Box> boxes{{{east, -9, 0}, {east + 0.1, 9, 2.5}},
                         {{west - 0.1, -9, 0}, {west, 9, 2.5}},
                         {{-9, north, 0}, {9, north + 0.1, 2.5}},
                         {{-9, south - 0.1, 0}, {9, south, 2.5}}};
  for (int i = 0; i < 5; ++i) {
    const double x = between(-2.5, 2.5), y = between(-2.5, 2.5);
    if (std::max(std::abs(x), std::abs(y)) > 1.2) {
      boxes.push_back({{x - 0.15, y - 0.15, 0.0}, {x + 0.15, y + 0.15, between(0.7, 1.5)}});
    }
  }
  return boxes;
}

/// Share of the cells that both have seen that are free in one and occupied in the other, farther
/// from such in the other than a cell.
double disagreement(const LocalOccupancy& a, const LocalOccupancy& b) {
  int both = 0;
  int differ = 0;
  const auto has_near = [](const LocalOccupancy& seen, int x, int y, bool is_occupied) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int ix = x + dx, iy = y + dy;
        if (ix >= 0 && iy >= 0 && ix < seen.size && iy < seen.size &&
            (seen.occupancy[seen.index_of(ix, iy)] > 0.5F) == is_occupied) {
          return true;
        }
      }
    }
    return false;
  };
  for (int y = 0; y < a.size; ++y) {
    for (int x = 0; x < a.size; ++x) {
      const std::size_t i = a.index_of(x, y);
      if (a.confidence[i] > 0.0F && b.confidence[i] > 0.0F) {
        ++both;
        differ +=
            !has_near(b, x, y, a.occupancy[i] > 0.5F) || !has_near(a, x, y, b.occupancy[i] > 0.5F);
      }
    }
  }
  EXPECT_GT(both, 100);
  return static_cast<double>(differ) / both;
}

LocalOccupancy lidar_look(const std::vector<Box>& boxes, const Pose2& T_world_robot) {
  return RangeProjector{kGrid}.project(scan_of_boxes(boxes, 0.35, 720, T_world_robot));
}

LocalOccupancy depth_look(const std::vector<Box>& boxes, const Pose2& T_world_robot,
                          DepthProjector& projector, double tilt_rad = 0.0, double roll_rad = 0.0) {
  DepthImage image = depth_of_boxes(
      boxes, kCamera, camera_mount(0.0, kHeight_m, kPitch_rad + tilt_rad, roll_rad), T_world_robot);
  image.T_robot_camera = camera_mount(0.0, kHeight_m, kPitch_rad);  // as TF believes
  return RangeProjector{kGrid}.project(projector.scan(image));
}

TEST(DepthProjection, OccupancyIsThatOfALidarEvenWhereTheCameraIsTilted) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const std::vector<Box> boxes = room(rng);
    const Pose2 pose{0.4 * draw_uniform(rng) - 0.2, 0.4 * draw_uniform(rng) - 0.2,
                     2.0 * kPi * draw_uniform(rng)};
    const LocalOccupancy lidar = lidar_look(boxes, pose);
    for (const double tilt : {0.0, 2.0 * kPi / 180.0, -2.0 * kPi / 180.0}) {
      for (const double roll : {0.0, 2.0 * kPi / 180.0}) {
        SCOPED_TRACE("tilt " + std::to_string(tilt) + ", roll " + std::to_string(roll));
        DepthProjector projector{DepthParams{}};
        EXPECT_LT(disagreement(depth_look(boxes, pose, projector, tilt, roll), lidar), 0.01);
      }
    }
  }
}

TEST(DepthProjection, FourPivotsWithoutNoiseAreTheLookAllRound) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const std::vector<Box> boxes = room(rng);
    Panorama panorama{PanoramaParams{}};
    DepthProjector projector{DepthParams{}};
    LocalOccupancy all;
    for (int turn = 0; turn <= 4; ++turn) {
      const Pose2 pose{0.0, 0.0, turn * kPi / 2.0};
      all = panorama.fuse(depth_look(boxes, pose, projector), pose);
    }
    ASSERT_TRUE(panorama.is_complete());
    const LocalOccupancy lidar = lidar_look(boxes, {});
    EXPECT_LT(disagreement(all, lidar), 0.01);
    int gaps = 0;
    for (std::size_t i = 0; i < all.cell_count(); ++i) {
      gaps += lidar.confidence[i] > 0.0F && all.occupancy[i] == 0.5F;
    }
    EXPECT_LT(gaps, 0.005 * kGrid.size * kGrid.size) << "slivers of boxes at the rim of a bearing";
  }
}

TEST(DepthProjection, APanoramaTurnsWithTheRobot) {
  std::mt19937_64 rng{7};
  const std::vector<Box> boxes = room(rng);
  std::vector<LocalOccupancy> panoramas;
  for (int start = 0; start < 4; ++start) {
    Panorama panorama{PanoramaParams{}};
    DepthProjector projector{DepthParams{}};
    LocalOccupancy all;
    for (int turn = start; turn <= start + 4; ++turn) {
      const Pose2 pose{0.0, 0.0, turn * kPi / 2.0};
      all = panorama.fuse(depth_look(boxes, pose, projector), pose);
    }
    panoramas.push_back(all);
  }
  const int last = kGrid.size - 1;
  for (int quarter = 1; quarter < 4; ++quarter) {
    int differ = 0;
    for (int y = 0; y <= last; ++y) {
      for (int x = 0; x <= last; ++x) {
        // The first robot's axes, from those of one that faces `quarter` turns to the left of it.
        Cell c{x, y};
        for (int i = 0; i < quarter; ++i) {
          c = {last - c.y, c.x};
        }
        differ +=
            panoramas[0].occupancy[panoramas[0].index_of(c.x, c.y)] !=
            panoramas[static_cast<std::size_t>(quarter)].occupancy[panoramas[0].index_of(x, y)];
      }
    }
    EXPECT_LT(differ, 0.01 * kGrid.size * kGrid.size) << "rounding alone";
  }
}

TEST(DepthProjection, WhateverTheReadingsNothingIsNoNumber) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    DepthImage image;
    image.camera = CameraModel::from_field_of_view(40, 30, 0.3 + 2.0 * draw_uniform(rng));
    image.T_robot_camera = camera_mount(0.1, draw_uniform(rng), 3.0 * (draw_uniform(rng) - 0.5),
                                        draw_uniform(rng) - 0.5);
    image.depth_m.create(30, 40, CV_32FC1);
    for (int v = 0; v < 30; ++v) {
      for (int u = 0; u < 40; ++u) {
        const double choice = draw_uniform(rng);
        image.depth_m.at<float>(v, u) =
            static_cast<float>(choice < 0.1   ? std::nan("")
                               : choice < 0.2 ? HUGE_VAL
                               : choice < 0.3 ? -1.0
                               : choice < 0.4 ? 1e30 * draw_uniform(rng)
                                              : 8.0 * draw_uniform(rng));
      }
    }
    DepthProjector projector{DepthParams{}};
    const LocalOccupancy seen = RangeProjector{kGrid}.project(projector.scan(image));
    for (std::size_t i = 0; i < seen.cell_count(); ++i) {
      ASSERT_TRUE(seen.occupancy[i] >= 0.0F && seen.occupancy[i] <= 1.0F);
      ASSERT_TRUE(seen.confidence[i] >= 0.0F && seen.confidence[i] <= 1.0F);
    }
  }
}

}  // namespace
}  // namespace cmn
