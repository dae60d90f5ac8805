// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Depth images and point clouds -> the scan of a LiDAR that sees at all heights of the robot.
#pragma once

#include "coarse_map_nav/data/camera.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/data/point_cloud.hpp"
#include "coarse_map_nav/perception/floor_plane.hpp"
#include "coarse_map_nav/perception/range_projection.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cmn {

struct DepthParams {
  double increment_deg = 0.5;
  double range_min_m = 0.1;
  double range_max_m = 5.0;  ///< RealSense: noise grows with the square of the depth
  double lowest_m = 0.06;
  double highest_m = 0.8;  ///< the LoCoBot's 0.6 m, and tables
  double least_share = 0.004;
  FloorParams floor;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("increment_deg", self.increment_deg, Between{0.1, 5.0},
          "[deg] depth: between the bearings of the scan it becomes; at least the camera's pixels");
    visit("range_min_m", self.range_min_m, Between{0.01, 2.0}, "[m] depth: nearer points are none");
    visit("range_max_m", self.range_max_m, Between{0.5, 20.0},
          "[m] depth: farther ones only say that it is free so far");
    visit("lowest_m", self.lowest_m, Between{0.01, 0.5},
          "[m] depth: what rises less over the floor is floor");
    visit("highest_m", self.highest_m, Between{0.1, 3.0},
          "[m] depth: what is higher over the floor is not in the way");
    visit("least_share", self.least_share, Between{0.0, 0.2},
          "[-] depth: points that have fewer around them, of those of their bearing, are noise");
    visit.group("floor", self.floor);
  }
};

/// What became of the points of one look.
struct DepthReport {
  std::size_t points = 0;    ///< with a reading
  std::size_t unusable = 0;  ///< NaN, inf, 0, negative or too near
  std::size_t flying = 0;    ///< between two surfaces, on neither
  std::size_t isolated = 0;  ///< in the way, but alone there
  FloorSource floor = FloorSource::kNominal;
  FloorPlane plane;
};

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
  explicit DepthProjector(const DepthParams& params) : params_{params}, floor_{params.floor} {}

  /// Of the field of view of the image.
  RangeScan scan(const DepthImage& image);
  /// All around the origin of the cloud, whose field of view nobody knows.
  RangeScan scan(const PointCloudView& cloud);
  /// Of the last scan.
  const DepthReport& report() const { return report_; }

 private:
  /// Points by bearing and log range.
  struct Bin {
    float square_sum_m2 = 0.0F;   ///< of the ranges of those in the way
    std::uint32_t obstacles = 0;  ///< in the way
    std::uint32_t points = 0;     ///< these and those of the floor
  };
  template <class Source>
  RangeScan scan_of(const Source& source, RangeScan layout);
  template <class Source>
  FloorPlane floor_of(const Source& source);
  void sort_in(std::size_t count, bool is_organised, const RangeScan& layout,
               const FloorPlane& plane);
  /// Of the piece of a row: ranges, heights over the floor, rows of bins_.
  void measure(std::size_t count, const RangeScan& layout, const FloorPlane& plane);
  void read_out(RangeScan& scan);

  DepthParams params_;
  FloorEstimator floor_;
  DepthReport report_;
  float height_m_ = 0.0F;  ///< of the camera over the nominal floor
  std::size_t range_bins_ = 0;
  /// Bearings + 2, range_bins_ each, with a row of none at either end; then one for all the rest.
  std::vector<Bin> bins_;
  std::vector<Eigen::Vector3f> candidates_;
  std::vector<float> x_, y_, z_, square_m2_, bearing_;  ///< a piece of a row
  std::vector<std::int32_t> bin_;                       ///< of its points
  std::vector<std::uint32_t> in_way_;                   ///< 1 for those in the way
};

}  // namespace cmn
