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
    const Comparison look_compared = compare(ours, theirs);
    both += look_compared.both;
    differ += look_compared.differ;
  }
  RecordProperty("share_of_cells_that_differ", std::to_string(1.0 * differ / both));
  EXPECT_GT(both, 4000);
  EXPECT_LT(differ, 0.01 * both);
}

}  // namespace
}  // namespace cmn
