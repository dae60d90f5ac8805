// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Depth images and point clouds -> the scan of a LiDAR that sees at all heights of the robot.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/point_cloud.hpp"
#include "coarse_map_nav/perception/depth_params.hpp"
#include "coarse_map_nav/perception/floor_plane.hpp"
#include "coarse_map_nav/perception/polar_counts.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

#include <vector>

namespace cmn {

struct FloorView;

/// Makes of a look of a depth camera what a LiDAR at the camera's place on the floor would have
/// measured, had it seen all that stands between `lowest_m` and `highest_m` over the floor (Robb,
/// "depth local occupancy": drop the floor, project, nearest point wins).
///
/// The bearings are about the camera, since it is from there that the ground is seen to be free.
/// The points of each are counted by log range; the nearest range that has enough points around it
/// is the obstacle's, so that flying pixels and noise are none, and its measured range is the mean
/// where they lie densest. In the rows of an image, points that lie far behind the one and far
/// before the other neighbour are dropped first: the blur between an object and what is behind it.
/// A bearing without obstacles is free as far as floor or anything else was seen along it
/// (RangeScan::Sight), and nothing is known of one in which nothing was seen. Memory and time grow
/// with the number of points; nothing is allocated from look to look.
class DepthProjector {
 public:
  explicit DepthProjector(const DepthParams& params)
      : params_{params}, floor_{params.floor}, counts_{params} {}

  /// Of the field of view of the image.
  RangeScan scan(const DepthImage& image);
  /// All around the origin of the cloud, whose field of view nobody knows.
  RangeScan scan(const PointCloudView& cloud);
  /// Of the last scan.
  const DepthReport& report() const { return report_; }

 private:
  template <class Points>
  void fill(RangeScan& scan, Points points, const FloorView& nominal);
  template <class Points>
  FloorPlane floor_of(const Points& points, const FloorView& nominal);

  DepthParams params_;
  FloorEstimator floor_;
  DepthReport report_;
  PolarCounts counts_;
  PointPiece piece_;
  std::vector<Eigen::Vector3f> candidates_;
};

}  // namespace cmn
