// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The plain way from a depth camera's points to local occupancy, with PCL: what DepthProjector is
/// compared with.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/perception/depth_projection.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "depth_images.hpp"
#include <pcl/PCLPointCloud2.h>
#include <pcl/common/transforms.h>
#include <pcl/conversions.h>
#include <pcl/filters/passthrough.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace cmn {

/// The image as a message of points, `point_step` bytes each, as PCL has it.
inline pcl::PCLPointCloud2 pcl_message_of(const DepthImage& image, std::size_t point_step) {
  pcl::PCLPointCloud2 message;
  message.width = static_cast<std::uint32_t>(image.camera.width);
  message.height = static_cast<std::uint32_t>(image.camera.height);
  message.point_step = static_cast<std::uint32_t>(point_step);
  message.row_step = message.width * message.point_step;
  message.is_dense = 0;
  for (const char* name : {"x", "y", "z"}) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = static_cast<std::uint32_t>(sizeof(float) * message.fields.size());
    field.datatype = pcl::PCLPointField::FLOAT32;
    field.count = 1;
    message.fields.push_back(field);
  }
  message.data = cloud_bytes_of(image, point_step);
  return message;
}

struct ReferenceParams {
  double leaf_m = 0.03;
  bool removes_outliers = false;
};

/// From the bytes of a message to occupancy: read, thinned, turned into the robot's frame, cut to
/// the height band, and each point traced from the camera (Bresenham): free up to it, occupied
/// there, if it is in the band; floor points are traced too. What lies behind a hit stays unseen,
/// as nobody traces through it: nearest point wins where a free trace runs over an occupied cell.
/// Thinning comes first, since it is quickest so; the clouds are kept from look to look, as ours
/// keeps its buffers. The floor is where the mount says.
class ReferencePipeline {
 public:
  ReferencePipeline(const DepthParams& params, const ProjectionParams& grid,
                    const ReferenceParams& how)
      : params_{params}, grid_{grid}, removes_outliers_{how.removes_outliers} {
    const auto leaf_m = static_cast<float>(how.leaf_m);
    voxels_.setLeafSize(leaf_m, leaf_m, leaf_m);
    band_.setFilterFieldName("z");
    band_.setFilterLimits(static_cast<float>(-params.lowest_m),
                          static_cast<float>(params.highest_m));
    outliers_.setMeanK(10);
    outliers_.setStddevMulThresh(2.0);
  }

  LocalOccupancy project(const pcl::PCLPointCloud2& message,
                         const Eigen::Isometry3d& T_robot_camera) {
    pcl::fromPCLPointCloud2(message, *measured_);
    voxels_.setInputCloud(measured_);
    voxels_.filter(*thinned_);
    pcl::transformPointCloud(*thinned_, *in_robot_, T_robot_camera.matrix().cast<float>());
    band_.setInputCloud(in_robot_);
    band_.filter(*in_band_);
    if (removes_outliers_) {
      outliers_.setInputCloud(in_band_);
      outliers_.filter(*clean_);
    }
    return traced(removes_outliers_ ? *clean_ : *in_band_, T_robot_camera.translation());
  }

 private:
  using Cloud = pcl::PointCloud<pcl::PointXYZ>;

  Cell cell_of(double x, double y) const {
    const double cell_m = grid_.side_m / grid_.size;
    return {static_cast<int>(std::floor(x / cell_m + 0.5 * grid_.size)),
            static_cast<int>(std::floor(y / cell_m + 0.5 * grid_.size))};
  }
  bool is_within(Cell c) const {
    return c.x >= 0 && c.y >= 0 && c.x < grid_.size && c.y < grid_.size;
  }

  LocalOccupancy traced(const Cloud& points, const Eigen::Vector3d& camera) const {
    LocalOccupancy seen{grid_.size, grid_.side_m / grid_.size};
    const Cell from = cell_of(camera.x(), camera.y());
    for (const pcl::PointXYZ& p : points) {
      const double px = static_cast<double>(p.x), py = static_cast<double>(p.y);
      const Cell to = cell_of(px, py);
      trace_free(from, to, seen);
      const double range_m = std::hypot(px - camera.x(), py - camera.y());
      if (is_within(to) && range_m <= params_.range_max_m &&
          static_cast<double>(p.z) > params_.lowest_m) {
        seen.occupancy[seen.index_of(to.x, to.y)] = 1.0F;
        seen.confidence[seen.index_of(to.x, to.y)] = 1.0F;
      }
    }
    return seen;
  }

  void trace_free(Cell from, Cell to, LocalOccupancy& seen) const {
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
  }

  DepthParams params_;
  ProjectionParams grid_;
  bool removes_outliers_;
  pcl::VoxelGrid<pcl::PointXYZ> voxels_;
  pcl::PassThrough<pcl::PointXYZ> band_;
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> outliers_;
  Cloud::Ptr measured_{new Cloud}, thinned_{new Cloud}, in_robot_{new Cloud}, in_band_{new Cloud},
      clean_{new Cloud};
};

/// Of the cells that both have seen.
struct Comparison {
  int both = 0;
  int differ = 0;
  double agreement() const { return both == 0 ? 0.0 : 1.0 - 1.0 * differ / both; }
};

/// A cell differs when the other has nothing of its kind within a cell of it, seen by both: the
/// middles of voxels are not the points. Both ways, so that neither may have what the other lacks.
inline Comparison compare(const LocalOccupancy& ours, const LocalOccupancy& theirs) {
  const auto has_near = [](const LocalOccupancy& seen, int x, int y, bool is_occupied) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const std::size_t i = seen.index_of(x + dx, y + dy);
        if (seen.confidence[i] == 1.0F && (seen.occupancy[i] > 0.5F) == is_occupied) {
          return true;
        }
      }
    }
    return false;
  };
  Comparison result;
  for (int y = 1; y + 1 < ours.size; ++y) {
    for (int x = 1; x + 1 < ours.size; ++x) {
      const std::size_t i = ours.index_of(x, y);
      if (ours.confidence[i] == 1.0F && theirs.confidence[i] == 1.0F) {
        ++result.both;
        result.differ += !has_near(theirs, x, y, ours.occupancy[i] > 0.5F) ||
                         !has_near(ours, x, y, theirs.occupancy[i] > 0.5F);
      }
    }
  }
  return result;
}

}  // namespace cmn
