// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/scene/extrusion.hpp"

#include <algorithm>
#include <cmath>

namespace cmn {
namespace {

constexpr float kBelowCeiling_m = 0.3F;

/// Walls along the lines between rows of cells (or, with x and y swapped, between columns), each
/// with its face to the free side.
class WallRow {
 public:
  WallRow(MeshScene& scene, const CoarseMap& map, float height, std::uint32_t material)
      : scene_{scene}, map_{map}, height_{height}, material_{material} {}

  void add(bool is_swapped) const {
    const int along = is_swapped ? map_.height() : map_.width();
    const int across = is_swapped ? map_.width() : map_.height();
    for (int line = 0; line <= across; ++line) {
      for (const int ahead : {0, 1}) {  // the free side: below the line, above it
        int first = 0;
        for (int i = 0; i <= along; ++i) {
          const auto cell = [&](int row) { return is_swapped ? Cell{row, i} : Cell{i, row}; };
          const bool is_wall = i < along && map_.is_free(cell(line - 1 + ahead)) &&
                               map_.is_occupied(cell(line - ahead));
          if (!is_wall) {
            if (first < i) {
              add(is_swapped, line, first, i, (ahead == 1) != is_swapped);
            }
            first = i + 1;
          }
        }
      }
    }
  }

 private:
  void add(bool is_swapped, int line, int first, int end, bool is_turned) const {
    const auto size = static_cast<float>(map_.resolution());
    const auto corner = [&](int i, float z) {
      const Eigen::Vector3f p{static_cast<float>(i) * size, static_cast<float>(line) * size, z};
      return is_swapped ? Eigen::Vector3f{p.y(), p.x(), z} : p;
    };
    const int from = is_turned ? end : first;
    const int to = is_turned ? first : end;
    scene_.add_quad(
        {corner(from, 0.0F), corner(to, 0.0F), corner(to, height_), corner(from, height_)},
        material_);
  }

  MeshScene& scene_;
  const CoarseMap& map_;
  float height_;
  std::uint32_t material_;
};

}  // namespace

std::vector<Rectangle> rectangles_of(const Grid<std::uint8_t>& grid, std::uint8_t value) {
  std::vector<Rectangle> rectangles;
  Grid<std::uint8_t> is_taken{grid.width(), grid.height()};
  const auto is_open = [&](Cell c) {
    return grid.contains(c) && grid(c) == value && is_taken(c) == 0;
  };
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Cell first = grid.cell_at(i);
    if (!is_open(first)) {
      continue;
    }
    Cell end{first.x, first.y};
    while (is_open({end.x, first.y})) {
      ++end.x;
    }
    const auto is_row_open = [&](int y) {
      for (int x = first.x; x < end.x; ++x) {
        if (!is_open({x, y})) {
          return false;
        }
      }
      return true;
    };
    while (is_row_open(end.y)) {
      for (int x = first.x; x < end.x; ++x) {
        is_taken({x, end.y}) = 1;
      }
      ++end.y;
    }
    rectangles.push_back({first.x + 0.0, first.y + 0.0, end.x + 0.0, end.y + 0.0});
  }
  return rectangles;
}

void add_lamps(MeshScene& scene, const Eigen::AlignedBox3f& area, double spacing_m) {
  const Eigen::Vector3f size = area.sizes();
  const auto count = [&](float length) {
    return std::clamp(static_cast<int>(std::lround(length / spacing_m)), 1, 64);
  };
  const int columns = count(size.x());
  const int rows = count(size.y());
  for (int i = 0; i < columns * rows; ++i) {
    Light lamp;
    lamp.position = {
        area.min().x() + size.x() * (static_cast<float>(i % columns) + 0.5F) / float(columns),
        area.min().y() + size.y() * (static_cast<float>(i / columns) + 0.5F) / float(rows),
        area.max().z() - kBelowCeiling_m};
    scene.lights.push_back(lamp);
  }
}

MeshScene extrude(const CoarseMap& map, const ExtrusionParams& params) {
  MeshScene grid;
  const auto height = static_cast<float>(params.height_m);
  const std::uint32_t wall = grid.add_material({"wall", {0.82F, 0.80F, 0.76F}, {}});
  const std::uint32_t floor = grid.add_material({"floor", {0.55F, 0.45F, 0.36F}, {}});
  const std::uint32_t ceiling = grid.add_material({"ceiling", {0.9F, 0.9F, 0.9F}, {}});
  const WallRow walls{grid, map, height, wall};
  walls.add(false);
  walls.add(true);
  for (const Rectangle& cells : rectangles_of(map.occupied(), 0)) {
    const auto size = static_cast<float>(map.resolution());
    const float x0 = size * static_cast<float>(cells.x0);
    const float y0 = size * static_cast<float>(cells.y0);
    const float x1 = size * static_cast<float>(cells.x1);
    const float y1 = size * static_cast<float>(cells.y1);
    grid.add_quad({Eigen::Vector3f{x0, y0, 0.0F}, {x1, y0, 0.0F}, {x1, y1, 0.0F}, {x0, y1, 0.0F}},
                  floor);
    if (params.has_ceiling) {
      grid.add_quad(
          {Eigen::Vector3f{x0, y1, height}, {x1, y1, height}, {x1, y0, height}, {x0, y0, height}},
          ceiling);
    }
  }
  add_lamps(grid, grid.bounds());
  MeshScene scene;
  const Pose2& T_map_grid = map.T_map_grid();
  add(scene, grid,
      Eigen::Affine3d{Eigen::Translation3d{T_map_grid.x, T_map_grid.y, 0.0} *
                      Eigen::AngleAxisd{T_map_grid.yaw, Eigen::Vector3d::UnitZ()}});
  return scene;
}

}  // namespace cmn
