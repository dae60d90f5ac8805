// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The plain way from a depth image to local occupancy, with PCL: what DepthProjector is compared
/// with.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/perception/depth_projection.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

#include <cmath>
#include <cstdlib>

#include <pcl/common/transforms.h>
#include <pcl/filters/passthrough.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace cmn {

inline pcl::PointCloud<pcl::PointXYZ>::Ptr pcl_cloud_of(const DepthImage& image) {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud{new pcl::PointCloud<pcl::PointXYZ>};
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) {
      const float read = image.depth_m.at<float>(v, u);
      const float depth = read > 0.0F ? read : NAN;
      cloud->emplace_back(static_cast<float>((u - image.camera.cx) / image.camera.fx) * depth,
                          static_cast<float>((v - image.camera.cy) / image.camera.fy) * depth,
                          depth);
    }
  }
  cloud->is_dense = false;
  return cloud;
}

/// Thinned, turned into the robot's frame, cut to the height band, and each point traced from the
/// camera (Bresenham): free up to it, occupied there, if it is in the band; floor points are traced
/// too. What lies behind a hit stays unseen, as nobody traces through it: nearest point wins where
/// a free trace runs over an occupied cell.
inline LocalOccupancy reference_occupancy(const pcl::PointCloud<pcl::PointXYZ>::Ptr& measured,
                                          const DepthImage& image, const DepthParams& params,
                                          const ProjectionParams& grid, bool removes_outliers) {
  using Cloud = pcl::PointCloud<pcl::PointXYZ>;
  Cloud::Ptr thinned{new Cloud};
  pcl::VoxelGrid<pcl::PointXYZ> voxels;
  voxels.setInputCloud(measured);
  voxels.setLeafSize(0.03F, 0.03F, 0.03F);
  voxels.filter(*thinned);
  Cloud::Ptr in_robot{new Cloud};
  pcl::transformPointCloud(*thinned, *in_robot, image.T_robot_camera.matrix().cast<float>());
  Cloud::Ptr in_band{new Cloud};
  pcl::PassThrough<pcl::PointXYZ> band;
  band.setInputCloud(in_robot);
  band.setFilterFieldName("z");
  band.setFilterLimits(static_cast<float>(-params.lowest_m), static_cast<float>(params.highest_m));
  band.filter(*in_band);
  if (removes_outliers) {
    Cloud::Ptr clean{new Cloud};
    pcl::StatisticalOutlierRemoval<pcl::PointXYZ> outliers;
    outliers.setInputCloud(in_band);
    outliers.setMeanK(10);
    outliers.setStddevMulThresh(2.0);
    outliers.filter(*clean);
    in_band = clean;
  }

  LocalOccupancy seen{grid.size, grid.side_m / grid.size};
  const auto cell_of = [&](double x, double y) {
    return Cell{static_cast<int>(std::floor(x / seen.resolution + 0.5 * grid.size)),
                static_cast<int>(std::floor(y / seen.resolution + 0.5 * grid.size))};
  };
  const auto is_within = [&](Cell c) {
    return c.x >= 0 && c.y >= 0 && c.x < grid.size && c.y < grid.size;
  };
  const Eigen::Vector3d camera = image.T_robot_camera.translation();
  const Cell from = cell_of(camera.x(), camera.y());
  for (const pcl::PointXYZ& p : *in_band) {
    const Cell to = cell_of(p.x, p.y);
    const double range_m = std::hypot(p.x - camera.x(), p.y - camera.y());
    const int dx = std::abs(to.x - from.x), dy = -std::abs(to.y - from.y);
    const int sx = from.x < to.x ? 1 : -1, sy = from.y < to.y ? 1 : -1;
    int error = dx + dy;
    for (Cell c = from; is_within(c) && c != to;) {
      const std::size_t i = seen.index_of(c.x, c.y);
      if (seen.confidence[i] == 0.0F) {
        seen.occupancy[i] = 0.0F;
        seen.confidence[i] = 1.0F;
      }
      const int twice = 2 * error;
      error += (twice >= dy ? dy : 0) + (twice <= dx ? dx : 0);
      c = {c.x + (twice >= dy ? sx : 0), c.y + (twice <= dx ? sy : 0)};
    }
    if (is_within(to) && range_m <= params.range_max_m &&
        static_cast<double>(p.z) > params.lowest_m) {
      seen.occupancy[seen.index_of(to.x, to.y)] = 1.0F;
      seen.confidence[seen.index_of(to.x, to.y)] = 1.0F;
    }
  }
  return seen;
}

/// Of the cells that both have seen.
struct Comparison {
  int both = 0;
  int differ = 0;
  double agreement() const { return both == 0 ? 0.0 : 1.0 - 1.0 * differ / both; }
};

/// A cell differs when the other has nothing of its kind within a cell of it: the middles of voxels
/// are not the points.
inline Comparison compare(const LocalOccupancy& ours, const LocalOccupancy& theirs) {
  Comparison result;
  for (int y = 1; y + 1 < ours.size; ++y) {
    for (int x = 1; x + 1 < ours.size; ++x) {
      const std::size_t i = ours.index_of(x, y);
      if (ours.confidence[i] != 1.0F || theirs.confidence[i] != 1.0F) {
        continue;
      }
      ++result.both;
      bool has_match = false;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          has_match |= (theirs.occupancy[ours.index_of(x + dx, y + dy)] > 0.5F) ==
                       (ours.occupancy[i] > 0.5F);
        }
      }
      result.differ += !has_match;
    }
  }
  return result;
}

}  // namespace cmn
