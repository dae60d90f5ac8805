// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The fast way from a depth image to occupancy against the plain one with PCL.
#include "depth_reference.hpp"

#include "box_room.hpp"
#include "depth_images.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

TEST(DepthReference, ThePlainPipelineOfPclSeesTheSame) {
  const ProjectionParams grid{80, 8.0, 0.0};
  int both = 0;
  int differ = 0;
  for (int look = 0; look < 8; ++look) {
    const Pose2 pose{0.0, 0.0, look * kPi / 4.0};
    const DepthImage image =
        noisy(depth_of_boxes(furnished_room(), CameraModel::from_field_of_view(320, 240, 1.5),
                             camera_mount(0.1, 0.55, 0.2), pose),
              static_cast<std::uint32_t>(look));
    DepthProjector projector{DepthParams{}};
    const LocalOccupancy ours = RangeProjector{grid}.project(projector.scan(image));
    const LocalOccupancy theirs =
        reference_occupancy(pcl_cloud_of(image), image, DepthParams{}, grid, true);
    for (int y = 1; y + 1 < grid.size; ++y) {
      for (int x = 1; x + 1 < grid.size; ++x) {
        const std::size_t i = ours.index_of(x, y);
        if (ours.confidence[i] != 1.0F || theirs.confidence[i] != 1.0F) {
          continue;
        }
        ++both;
        bool has_match = false;  // within a cell: the voxels' middles are not the points
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            has_match |= (theirs.occupancy[ours.index_of(x + dx, y + dy)] > 0.5F) ==
                         (ours.occupancy[i] > 0.5F);
          }
        }
        differ += !has_match;
      }
    }
  }
  RecordProperty("share_of_cells_that_differ", std::to_string(1.0 * differ / both));
  EXPECT_GT(both, 4000);
  EXPECT_LT(differ, 0.01 * both);
}

}  // namespace
}  // namespace cmn
