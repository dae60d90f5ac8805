// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The fast way from a depth camera's points to occupancy against the plain one with PCL.
#include "depth_reference.hpp"

#include <random>
#include <string>

#include "box_room.hpp"
#include "depth_images.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr std::size_t kPointStep = 32;

/// Readings that are anywhere, one in 2000.
void stray(DepthImage& image, std::uint32_t seed) {
  std::mt19937 rng{seed};
  std::uniform_real_distribution<float> anywhere{0.0F, 5.0F};
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) {
      if (rng() % 2000 == 0) {
        image.depth_m.at<float>(v, u) = anywhere(rng);
      }
    }
  }
}

/// Eight looks round a furnished room, from the same bytes.
Comparison compare_looks(const ReferenceParams& how, bool has_strays) {
  const ProjectionParams grid{80, 8.0, 0.0};
  ReferencePipeline reference{DepthParams{}, grid, how};
  Comparison all;
  for (int look = 0; look < 8; ++look) {
    const Pose2 pose{0.0, 0.0, look * kPi / 4.0};
    const auto seed = static_cast<std::uint32_t>(look);
    DepthImage image =
        noisy(depth_of_boxes(furnished_room(), CameraModel::from_field_of_view(320, 240, 1.5),
                             camera_mount(0.1, 0.55, 0.2), pose),
              seed);
    if (has_strays) {
      stray(image, seed);
    }
    const pcl::PCLPointCloud2 message = pcl_message_of(image, kPointStep);
    DepthProjector projector{DepthParams{}};
    const LocalOccupancy ours = RangeProjector{grid}.project(
        projector.scan(view_of(message.data, image, kPointStep, true)));
    const Comparison compared = compare(ours, reference.project(message, image.T_robot_camera));
    all.both += compared.both;
    all.differ += compared.differ;
  }
  return all;
}

TEST(DepthReference, ThePlainPipelineOfPclSeesTheSame) {
  for (const double leaf_m : {0.03, 0.1}) {
    SCOPED_TRACE("leaf " + std::to_string(leaf_m));
    const Comparison compared = compare_looks({leaf_m, false}, false);
    EXPECT_GT(compared.both, 4000);
    EXPECT_LT(compared.differ, 0.002 * compared.both);
  }
}

TEST(DepthReference, WithStrayReadingsItNeedsItsOutliersRemovedAndOursDoesNot) {
  const Comparison plain = compare_looks({0.03, false}, true);
  const Comparison clean = compare_looks({0.03, true}, true);
  EXPECT_GT(clean.both, 4000);
  EXPECT_LT(clean.differ, 0.002 * clean.both);
  EXPECT_GT(plain.differ, 0.005 * plain.both) << "strays stand in the map as obstacles";
}

}  // namespace
}  // namespace cmn
