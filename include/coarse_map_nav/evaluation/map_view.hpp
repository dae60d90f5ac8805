// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A map in a picture, and the symbols that are set on it.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/evaluation/canvas.hpp"

#include <vector>

#include <opencv2/core.hpp>

namespace cmn {

/// Colours of maps and symbols (BGR).
struct MapColours {
  cv::Scalar paper{247, 249, 250};
  cv::Scalar ink{52, 44, 38};
  cv::Scalar faint_ink{128, 118, 110};
  cv::Scalar wall{96, 84, 74};
  cv::Scalar white{255, 255, 255};
  cv::Scalar estimate{200, 90, 20};
  cv::Scalar truth{80, 150, 20};
  cv::Scalar goal{150, 20, 190};
};
inline const MapColours kMapColours;

/// A grid map that fills an area of a canvas.
struct MapView {
  const CoarseMap* map;
  cv::Rect2d area;

  double scale() const { return area.width / (map->width() * map->resolution()); }  ///< [px/m]
  cv::Point2d at(Point2 p_map) const {
    const Point2 p = inverse(map->T_map_grid()) * p_map;
    return {area.x + p.x * scale(), area.br().y - p.y * scale()};
  }
  /// The direction on the canvas, x right and y up.
  double turned(double yaw) const { return yaw - map->T_map_grid().yaw; }
};

/// As large as fits into `most`, in the middle of its width.
MapView view_in(const CoarseMap& map, cv::Point2d corner, cv::Size2d most);

/// Occupied cells dark, free ones white; one pixel a cell, rows from the top down.
cv::Mat walls_of(const CoarseMap& map);

/// The same for a building whose surroundings are unknown, which counts as occupied: only what lies
/// within `depth_m` of free ground is dark, the rest is paper.
cv::Mat walls_of(const CoarseMap& map, double depth_m);

/// The part of a map around points, no nearer to its edge than `margin_m` where the map goes on.
CoarseMap cut_out(const CoarseMap& map, const std::vector<Point2>& points_map, double margin_m);

// Symbols of about `size` pixels' radius.
void draw_goal(Canvas& canvas, cv::Point2d at, double size);
/// A dart; hollow: the filter itself is not sure of it.
void draw_estimate(Canvas& canvas, cv::Point2d at, double size, double yaw, bool is_sure);
/// The robot as it really stands, seen from above.
void draw_robot(Canvas& canvas, cv::Point2d at, double size, double yaw);
void draw_start(Canvas& canvas, cv::Point2d at, double size);

}  // namespace cmn
