// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/slice.hpp"

#include "coarse_map_nav/data/whole_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr double kTouch_m = 1e-3;
/// Floors lie so near to their height.
constexpr double kUneven_m = 0.1;
constexpr double kHair_m = 1e-9;  ///< a plane is a band as well: nothing of it is rounded away
/// Of open ground around the obstacles.
constexpr double kMargin_m = 1.0;
constexpr double kMostCells = 64e6;

using Polygon = std::vector<Eigen::Vector3d>;

/// What of a convex polygon lies above `limit` along an axis, or below it with `side` = -1.
Polygon clipped(const Polygon& polygon, int axis, double limit, double side) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d& a = polygon[i];
    const Eigen::Vector3d& b = polygon[(i + 1) % polygon.size()];
    const double over_a = side * (a[axis] - limit);
    const double over_b = side * (b[axis] - limit);
    if (over_a >= 0.0) {
      kept.push_back(a);
    }
    if ((over_a < 0.0) != (over_b < 0.0)) {
      kept.push_back(a + over_a / (over_a - over_b) * (b - a));
    }
  }
  return kept;
}

/// The part of a triangle within heights. Drawn in by a hair behind its face, so that a wall on the
/// border of two cells belongs to the one behind it.
Polygon part_of(const MeshScene& scene, const Triangle& triangle, double bottom_m, double top_m) {
  Polygon corners;
  for (const std::uint32_t corner : triangle.corners) {
    corners.push_back(scene.vertices[corner].cast<double>());
  }
  const auto [low, high] = std::minmax({corners[0].z(), corners[1].z(), corners[2].z()});
  if (low > top_m || high < bottom_m) {
    return {};
  }
  const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double length = normal.head<2>().norm();
  if (length > 0.1 * normal.norm()) {
    for (Eigen::Vector3d& p : corners) {
      p.head<2>() -= kTouch_m / length * normal.head<2>();
    }
  }
  return clipped(clipped(corners, 2, bottom_m, 1.0), 2, top_m, -1.0);
}

/// A grid of the plane whose cells are set by what crosses them.
class Raster {
 public:
  Raster(const Eigen::AlignedBox2d& area, double resolution_m) : resolution_m_{resolution_m} {
    const auto low = [&](double metres) { return std::floor(metres / resolution_m); };
    const Eigen::Vector2d size = (area.sizes() / resolution_m).array() + 2.0;
    if (!(size.x() * size.y() <= kMostCells)) {
      throw std::runtime_error("the scene is too large to be sliced at " +
                               std::to_string(resolution_m) + " m a cell");
    }
    origin_ = {whole_below(low(area.min().x())), whole_below(low(area.min().y()))};
    cells_ = cv::Mat::zeros(static_cast<int>(size.y()), static_cast<int>(size.x()), CV_8U);
  }

  /// Sets the cells that a convex polygon crosses.
  void set(const Polygon& polygon) {
    if (polygon.empty()) {
      return;
    }
    const auto [first, last] = span(polygon, 1, origin_.y, cells_.rows);
    for (int row = first; row <= last; ++row) {
      const double y = (origin_.y + row) * resolution_m_;
      const Polygon strip = clipped(clipped(polygon, 1, y, 1.0), 1, y + resolution_m_, -1.0);
      if (!strip.empty()) {
        const auto [left, right] = span(strip, 0, origin_.x, cells_.cols);
        for (int column = left; column <= right; ++column) {
          cells_.at<std::uint8_t>(row, column) = 255;
        }
      }
    }
  }

  const cv::Mat& cells() const { return cells_; }
  Cell cell_of(Point2 p) const {
    return {whole_below(p.x / resolution_m_) - origin_.x,
            whole_below(p.y / resolution_m_) - origin_.y};
  }
  Pose2 T_world_grid() const { return {origin_.x * resolution_m_, origin_.y * resolution_m_, 0.0}; }

 private:
  /// The first and last cell along an axis, within the grid; none: last < first.
  std::pair<int, int> span(const Polygon& polygon, int axis, int origin, int count) const {
    double low = polygon[0][axis];
    double high = low;
    for (const Eigen::Vector3d& p : polygon) {
      low = std::min(low, p[axis]);
      high = std::max(high, p[axis]);
    }
    const double shrink = std::min(kTouch_m, 0.5 * (high - low));
    const auto cell = [&](double metres) {
      return std::clamp(std::floor(metres / resolution_m_) - origin, -1.0, count + 0.0);
    };
    return {std::max(0, static_cast<int>(cell(low + shrink))),
            std::min(count - 1, static_cast<int>(cell(high - shrink)))};
  }

  double resolution_m_;
  Cell origin_;  ///< of the grid's lower left cell, counted from the scene's origin
  cv::Mat cells_;
};

/// Calls `take` with the part of each triangle that lies within heights.
template <class Take>
void for_each_part(const MeshScene& scene, double bottom_m, double top_m, const Take& take) {
  for (const Triangle& triangle : scene.triangles) {
    const Polygon part = part_of(scene, triangle, bottom_m, top_m);
    if (!part.empty()) {
      take(part);
    }
  }
}

/// In the scene [m].
struct Heights {
  explicit Heights(const SliceParams& params)
      : floor_m{params.floor_m},
        bottom_m{params.floor_m + params.band.bottom_m},
        top_m{params.floor_m + params.band.top_m + kHair_m} {}
  double floor_m;
  double bottom_m;
  double top_m;
};

/// Around what stands within the heights, or around the floor where nothing does. Throws
/// std::runtime_error when there is neither.
Eigen::AlignedBox2d area_of(const MeshScene& scene, const Heights& heights) {
  Eigen::AlignedBox2d area;
  const auto extend = [&](const Polygon& part) {
    for (const Eigen::Vector3d& p : part) {
      area.extend(p.head<2>());
    }
  };
  for_each_part(scene, heights.bottom_m, heights.top_m, extend);
  if (area.isEmpty()) {
    for_each_part(scene, heights.floor_m - kUneven_m, heights.bottom_m, extend);
  }
  if (area.isEmpty()) {
    throw std::runtime_error("the scene has no floor at height " + std::to_string(heights.floor_m) +
                             " m");
  }
  return {area.min().array() - kMargin_m, area.max().array() + kMargin_m};
}

/// The piece of `open` cells that holds `inside`, else the largest closed one; 0: none.
int piece_of(const cv::Mat& open, const cv::Mat& pieces, const cv::Mat& stats,
             const std::optional<Cell>& inside) {
  if (inside) {
    const bool is_in =
        inside->x >= 0 && inside->y >= 0 && inside->x < open.cols && inside->y < open.rows;
    return is_in ? pieces.at<std::int32_t>(inside->y, inside->x) : 0;
  }
  int best = 0;
  std::pair<bool, int> most{false, 0};
  for (int i = 1; i < stats.rows; ++i) {
    const auto* of = stats.ptr<std::int32_t>(i);
    const bool is_closed = of[cv::CC_STAT_LEFT] > 0 && of[cv::CC_STAT_TOP] > 0 &&
                           of[cv::CC_STAT_LEFT] + of[cv::CC_STAT_WIDTH] < open.cols &&
                           of[cv::CC_STAT_TOP] + of[cv::CC_STAT_HEIGHT] < open.rows;
    const std::pair<bool, int> merit{is_closed, of[cv::CC_STAT_AREA]};
    if (merit > most) {
      most = merit;
      best = i;
    }
  }
  return best;
}

/// 0 in the piece that is meant, 1 elsewhere. Throws std::runtime_error when there is none.
Grid<std::uint8_t> pieces_closed(const cv::Mat& open, const std::optional<Cell>& inside) {
  cv::Mat pieces;
  cv::Mat stats;
  cv::Mat middles;
  cv::connectedComponentsWithStats(open, pieces, stats, middles, 4, CV_32S);
  const int piece = piece_of(open, pieces, stats, inside);
  if (piece == 0) {
    throw std::runtime_error("the scene has no free floor" +
                             std::string{inside ? " at the point that is meant" : ""});
  }
  Grid<std::uint8_t> grid{open.cols, open.rows, 1};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Cell c = grid.cell_at(i);
    grid[i] = pieces.at<std::int32_t>(c.y, c.x) == piece ? 0 : 1;
  }
  return grid;
}

}  // namespace

CoarseMap slice(const MeshScene& scene, const SliceParams& params) {
  const Heights heights{params};
  const Eigen::AlignedBox2d area = area_of(scene, heights);
  Raster blocked{area, params.resolution_m};
  Raster floor{area, params.resolution_m};
  for_each_part(scene, heights.bottom_m, heights.top_m,
                [&](const Polygon& part) { blocked.set(part); });
  for_each_part(scene, heights.floor_m - kUneven_m,
                std::max(heights.floor_m, heights.bottom_m - kTouch_m),
                [&](const Polygon& part) { floor.set(part); });
  std::optional<Cell> inside;
  if (params.inside) {
    inside = blocked.cell_of(*params.inside);
  }
  return {pieces_closed(floor.cells() & ~blocked.cells(), inside), params.resolution_m,
          blocked.T_world_grid()};
}

}  // namespace cmn
