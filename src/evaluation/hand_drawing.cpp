// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/evaluation/drawing.hpp"
#include "coarse_map_nav/mapping/coarsen.hpp"
#include "coarse_map_nav/mapping/image_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr double kWobbleSlope = 0.5;  ///< lines wobble, but cross neither themselves nor others
constexpr int kLatticePx = 8;         ///< the picture is bent at every 8th pixel, linear between
constexpr int kMargin = 1;            ///< [cells] around the outermost free space

/// The world's cells as a picture; rows are y upwards here, as in the grid.
cv::Mat free_picture(const CoarseMap& world) {
  cv::Mat free(world.height() + 2, world.width() + 2, CV_8U, cv::Scalar{0});
  for (int y = 0; y < world.height(); ++y) {
    for (int x = 0; x < world.width(); ++x) {
      free.at<std::uint8_t>(y + 1, x + 1) = world.is_free({x, y}) ? 255 : 0;
    }
  }
  return free;
}

/// Free space as somebody remembers it who walked through it: what a disc of `radius_px` covers,
/// less a rim of up to one pixel that makes the thinnest wall 3 pixels thick; rooms of fewer than
/// `smallest_px` left out.
cv::Mat walked(const cv::Mat& free, double radius_px, double smallest_px) {
  cv::Mat distance;
  cv::distanceTransform(free, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  cv::Mat middle = distance <= radius_px;  // 0 where the disc's centre may be
  cv::distanceTransform(middle, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  const cv::Mat covered = distance <= std::max(0.0, radius_px - 1.0);
  cv::Mat room;
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(covered, room, stats, centroids, 4, CV_32S);
  std::vector<std::uint8_t> stays(static_cast<std::size_t>(count), 0);
  for (int i = 1; i < count; ++i) {
    stays[static_cast<std::size_t>(i)] =
        stats.at<int>(i, cv::CC_STAT_AREA) >= smallest_px ? 255 : 0;
  }
  cv::Mat result(free.size(), CV_8U);
  for (int y = 0; y < free.rows; ++y) {
    for (int x = 0; x < free.cols; ++x) {
      result.at<std::uint8_t>(y, x) = stays[static_cast<std::size_t>(room.at<int>(y, x))];
    }
  }
  return result;
}

/// Leaves out some of the small islands and moves others to where they still stand free.
void forget_furniture(cv::Mat& free, double pixels_per_metre, const HandDrawingParams& params,
                      std::mt19937_64& rng) {
  cv::Mat occupied = free == 0;
  cv::Mat island;
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(occupied, island, stats, centroids, 8, CV_32S);
  const double longest = params.small_furniture_m * pixels_per_metre;
  const double reach = params.move_m * pixels_per_metre;
  const int clearance =
      static_cast<int>(std::ceil(2.0 * params.walker_radius_m * pixels_per_metre));
  const cv::Rect sheet{0, 0, free.cols, free.rows};
  for (int i = 1; i < count; ++i) {
    const cv::Rect box{stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT)};
    if (std::max(box.width, box.height) > longest) {
      continue;
    }
    const double lot = draw_uniform(rng);
    const double direction = 2.0 * kPi * draw_uniform(rng);
    const double way = reach * draw_uniform(rng);
    if (lot >= params.dropped_share + params.moved_share) {
      continue;
    }
    const cv::Mat shape = island(box) == i;
    free(box).setTo(255, shape);
    if (lot < params.dropped_share) {
      continue;
    }
    const cv::Rect moved =
        box + cv::Point(static_cast<int>(std::lround(way * std::cos(direction))),
                        static_cast<int>(std::lround(way * std::sin(direction))));
    const cv::Rect around{moved.x - clearance, moved.y - clearance, moved.width + 2 * clearance,
                          moved.height + 2 * clearance};
    const bool stands_free =
        (around & sheet) == around && cv::countNonZero(free(around)) == around.area();
    free(stands_free ? moved : box).setTo(0, shape);
  }
}

/// The warp at full strength: no stretch relative to the mean leaves 1 +- `stretch`.
struct FittedWarp {
  SmoothWarp warp;
  double mean = 1.0;  ///< mean stretch, the root of the area's
};

FittedWarp fit(const SmoothWarp& full, double stretch, const std::vector<Point2>& places) {
  constexpr double kStep = 0.97;
  std::vector<Jacobian2> slopes;
  slopes.reserve(places.size());
  for (const Point2 p : places) {
    slopes.push_back(full.jacobian(p));
  }
  double height = 1.0;
  while (true) {
    double area = 0.0;
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (const Jacobian2& slope : slopes) {
      const Jacobian2 j{1.0 + height * (slope.xx - 1.0), height * slope.xy, height * slope.yx,
                        1.0 + height * (slope.yy - 1.0)};
      const std::pair<double, double> stretches = j.stretches();
      area += j.determinant();
      least = std::min(least, stretches.first);
      most = std::max(most, stretches.second);
    }
    const double mean = std::sqrt(area / static_cast<double>(places.size()));
    const bool is_within = least >= (1.0 - stretch) * mean && most <= (1.0 + stretch) * mean;
    if (is_within || height < 1e-6) {
      return {full.scaled(height), mean};
    }
    height *= kStep;
  }
}

Point2 world_point(const CoarseMap& world, double column, double row) {
  return world.T_map_grid() *
         Point2{(column - 1.0) * world.resolution(), (row - 1.0) * world.resolution()};
}

/// Where the drawing's pixels look in the picture of the world, found on a lattice.
void find_sources(const Drawing& drawing, const SmoothWarp& wobble, const CoarseMap& world,
                  double pixel_m, cv::Size size, cv::Mat& from_x, cv::Mat& from_y) {
  const int columns = size.width / kLatticePx + 2;
  const int rows = size.height / kLatticePx + 2;
  cv::Mat lattice_x(rows, columns, CV_32F);
  cv::Mat lattice_y(rows, columns, CV_32F);
  const Pose2 T_grid_world = inverse(world.T_map_grid());
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Point2 at{(i * kLatticePx + 0.5) * pixel_m, (j * kLatticePx + 0.5) * pixel_m};
      const Point2 p = T_grid_world * wobble(drawing.map_to_world(at));
      lattice_x.at<float>(j, i) = static_cast<float>(p.x / world.resolution() + 0.5);
      lattice_y.at<float>(j, i) = static_cast<float>(p.y / world.resolution() + 0.5);
    }
  }
  cv::Mat at_x(size, CV_32F);
  cv::Mat at_y(size, CV_32F);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      at_x.at<float>(y, x) = static_cast<float>(x) / kLatticePx;
      at_y.at<float>(y, x) = static_cast<float>(y) / kLatticePx;
    }
  }
  cv::remap(lattice_x, from_x, at_x, at_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::remap(lattice_y, from_y, at_x, at_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
}

/// What is wrong with a drawing.
struct Faults {
  SmoothWarp warp;
  double mean = 1.0;   ///< mean stretch of the warp
  double scale = 1.0;  ///< beside the warp
  int quarter_turns = 0;
  SmoothWarp wobble;
};

Faults draw_faults(std::mt19937_64& rng, const std::vector<Point2>& places,
                   const HandDrawingParams& params) {
  constexpr double kSteepest = 0.94;
  Faults faults;
  const FittedWarp fitted =
      fit(draw_warp(rng, 2.0 * params.stretch, params.stretch_length_m, params.bend),
          params.stretch, places);
  faults.warp = fitted.warp;
  faults.mean = fitted.mean;
  faults.scale = params.smallest_scale *
                 std::pow(params.largest_scale / params.smallest_scale, draw_uniform(rng)) /
                 fitted.mean;
  const auto lot = static_cast<int>(draw_index(rng, 4));
  faults.quarter_turns = params.turn ? lot : 0;
  const double slope = std::min(kWobbleSlope, 2.0 * kPi * params.wobble_m / params.wobble_length_m);
  faults.wobble = draw_warp(rng, std::min(2.0 * slope, kSteepest), params.wobble_length_m, 0.5);
  return faults;
}

/// Where the drawing lies on its sheet.
struct Sheet {
  Point2 shift;
  int width = 0;  ///< [cells]
  int height = 0;
};

/// As large as the outermost free space and a margin around it.
Sheet lay_sheet(const CoarseMap& world, const cv::Mat& free, double mpp, const Faults& faults,
                double margin) {
  const Drawing pen{CoarseMap{}, faults.warp, faults.scale, faults.quarter_turns, {}, 1.0};
  cv::Mat inner;
  cv::erode(free, inner, cv::Mat{});
  std::vector<cv::Point> rim;
  cv::findNonZero(free & ~inner, rim);
  Point2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point2 high{-low.x, -low.y};
  for (const cv::Point pixel : rim) {
    const Point2 q = pen.world_to_map(world_point(world, pixel.x + 0.5, pixel.y + 0.5));
    low = {std::min(low.x, q.x), std::min(low.y, q.y)};
    high = {std::max(high.x, q.x), std::max(high.y, q.y)};
  }
  return {{margin - low.x, margin - low.y},
          static_cast<int>(std::ceil((high.x - low.x + 2.0 * margin) / mpp)),
          static_cast<int>(std::ceil((high.y - low.y + 2.0 * margin) / mpp))};
}

/// The drawing in pixels of `mpp` / `per_cell`, with wobbly lines.
Grid<std::uint8_t> trace(const CoarseMap& world, const cv::Mat& free, const Drawing& pen,
                         const SmoothWarp& wobble, double pixel_m, cv::Size size) {
  cv::Mat from_x;
  cv::Mat from_y;
  find_sources(pen, wobble, world, pixel_m, size, from_x, from_y);
  cv::Mat drawn;
  cv::remap(free, drawn, from_x, from_y, cv::INTER_NEAREST, cv::BORDER_CONSTANT, cv::Scalar{0});
  Grid<std::uint8_t> occupied{drawn.cols, drawn.rows};
  for (int y = 0; y < drawn.rows; ++y) {
    for (int x = 0; x < drawn.cols; ++x) {
      occupied({x, y}) = drawn.at<std::uint8_t>(y, x) == 0 ? 1 : 0;
    }
  }
  return occupied;
}

void check(const CoarseMap& world, double mpp, const HandDrawingParams& params) {
  if (!(mpp >= world.resolution()) || !std::isfinite(mpp)) {
    throw std::invalid_argument("a drawing cannot have finer cells than the world");
  }
  if (!(params.smallest_scale <= params.largest_scale)) {
    throw std::invalid_argument("smallest_scale is above largest_scale");
  }
  if (!(params.dropped_share + params.moved_share <= 1.0)) {
    throw std::invalid_argument("dropped_share and moved_share are more than 1 together");
  }
}

}  // namespace

Drawing hand_drawn(const CoarseMap& world, double mpp, std::uint32_t seed,
                   const HandDrawingParams& params) {
  constexpr std::size_t kPlaces = 4000;
  check(world, mpp, params);
  std::mt19937_64 rng{seed};
  const double per_metre = 1.0 / world.resolution();
  cv::Mat free = walked(free_picture(world), params.walker_radius_m * per_metre,
                        params.smallest_room_m2 * per_metre * per_metre);
  forget_furniture(free, per_metre, params, rng);
  std::vector<cv::Point> pixels;
  cv::findNonZero(free, pixels);
  if (pixels.empty()) {
    throw std::runtime_error("the world has no room for a disc of " +
                             std::to_string(params.walker_radius_m) + " m: nothing to draw");
  }
  std::vector<Point2> places;
  const std::size_t stride = std::max<std::size_t>(1, pixels.size() / kPlaces);
  for (std::size_t i = 0; i < pixels.size(); i += stride) {
    places.push_back(world_point(world, pixels[i].x + 0.5, pixels[i].y + 0.5));
  }
  const Faults faults = draw_faults(rng, places, params);
  const double mean_scale = faults.scale * faults.mean;
  const double margin = kMargin * mpp + faults.scale * (params.wobble_m + world.resolution());
  const Sheet sheet = lay_sheet(world, free, mpp, faults, margin);
  // Pixels so small that the thinnest wall, 3 of the world's cells, is never stepped over.
  const double step =
      2.0 * world.resolution() * mean_scale * (1.0 - params.stretch) / (1.0 + kWobbleSlope);
  const int per_cell = std::max(6, static_cast<int>(std::ceil(mpp / step)));
  const auto drawing = [&](CoarseMap map) {
    return Drawing{std::move(map),       faults.warp, faults.scale,
                   faults.quarter_turns, sheet.shift, mean_scale};
  };
  const Grid<std::uint8_t> fine = trace(world, free, drawing({}), faults.wobble, mpp / per_cell,
                                        {sheet.width * per_cell, sheet.height * per_cell});
  return drawing({coarsen(fine, per_cell), mpp});
}

}  // namespace cmn
