// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/map_repair.hpp"

#include "coarse_map_nav/data/whole_number.hpp"

#include <algorithm>
#include <cmath>

namespace cmn {
namespace {

constexpr int kFailedCost = 300;

}  // namespace

RepairedMap::RepairedMap(const CoarseMap& drawing, const MapRepairParams& params)
    : drawing_{drawing},
      params_{params},
      cuts_{std::max(1, static_cast<int>(std::ceil(drawing.resolution() / params.cell_m - 1e-6)))},
      parts_{drawing.width() * cuts_, drawing.height() * cuts_} {
  forget();
}

Cell RepairedMap::part_of(Point2 position_cells) const {
  return {static_cast<int>(std::floor(position_cells.x * cuts_)),
          static_cast<int>(std::floor(position_cells.y * cuts_))};
}

int RepairedMap::cost(Cell c) const {
  const Part& part = parts_(c);
  return part.has_failed ? kFailedCost
         : part.is_open  ? 1
         : part.was_seen ? params_.seen_wall_cost
                         : params_.drawn_wall_cost;
}

int RepairedMap::dearest() const {
  return std::max({kFailedCost, params_.drawn_wall_cost, params_.seen_wall_cost});
}

RepairedMap::Part RepairedMap::drawn(std::size_t index) const {
  const Cell c = parts_.cell_at(index);
  const bool is_free = drawing_.is_free({c.x / cuts_, c.y / cuts_});
  return {static_cast<std::int8_t>(is_free ? 1 : -1), is_free, false, false};
}

void RepairedMap::forget() {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    parts_[i] = drawn(i);
  }
}

RepairedMap::Learned RepairedMap::exchange(const Learned& instead) {
  Learned before;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (parts_[i].was_seen || parts_[i].has_failed) {
      before.parts_.emplace_back(i, std::exchange(parts_[i], drawn(i)));
      changed_.push_back(parts_.cell_at(i));
    }
  }
  for (const auto& [i, part] : instead.parts_) {
    parts_[i] = part;
    changed_.push_back(parts_.cell_at(i));
  }
  return before;
}

void RepairedMap::Learned::forget_failures() {
  for (auto& [i, part] : parts_) {
    part.has_failed = false;
  }
}

bool RepairedMap::fuse(const LocalOccupancy& local, const ClearanceMap& clearance,
                       double least_clearance_m, Point2 position_cells, double yaw_rad,
                       double scale) {
  const double parts_per_m = scale * cuts_ / drawing_.resolution();
  const double pixel = local.resolution * parts_per_m;
  const Point2 along_x = turned(Point2{pixel, 0.0}, yaw_rad);
  const Point2 along_y{-along_x.y, along_x.x};
  const double half = 0.5 * local.size - 0.5;
  const Point2 corner = static_cast<double>(cuts_) * position_cells - half * (along_x + along_y);
  const double reach = std::sqrt(2.0) * 0.5 * local.size * pixel + 1.0;
  const Cell low{static_cast<int>(std::floor(cuts_ * position_cells.x - reach)),
                 static_cast<int>(std::floor(cuts_ * position_cells.y - reach))};
  const int side = 2 * static_cast<int>(std::ceil(reach)) + 2;
  tallies_.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), {});
  const auto tally_of = [&](Cell part) -> Tally& {
    return tallies_[static_cast<std::size_t>(part.y - low.y) * static_cast<std::size_t>(side) +
                    static_cast<std::size_t>(part.x - low.x)];
  };
  for (int iy = 0; iy < local.size; ++iy) {
    for (int ix = 0; ix < local.size; ++ix) {
      const Point2 p =
          corner + static_cast<double>(ix) * along_x + static_cast<double>(iy) * along_y;
      Tally& tally = tally_of({whole_below(p.x), whole_below(p.y)});
      const std::size_t i = local.index_of(ix, iy);
      const bool is_too_near = clearance.is_nearer_than(least_clearance_m, i);
      const bool was_seen = clearance.at_cell(i) >= 0.0;
      // Behind a wall, too: one that is seen from one side only would leak.
      tally.known += was_seen || is_too_near;
      tally.drivable += was_seen && !is_too_near;
    }
  }
  // A part at the rim of the view is judged by what of it is in view, if that is most of it.
  const double whole = 1.0 / (pixel * pixel);
  bool has_changed = false;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Cell c = low + Cell{x, y};
      const Tally& tally = tally_of(c);
      if (tally.known == 0 || !parts_.contains(c)) {
        continue;
      }
      const bool is_open = tally.drivable >= params_.open_share * whole;
      if (!is_open && tally.known < params_.known_share * whole) {
        continue;
      }
      const int before = cost(c);
      Part& part = parts_(c);
      part.was_seen = true;
      part.looks = static_cast<std::int8_t>(
          std::clamp(part.looks + (is_open ? 1 : -1), -kMostLooks, kMostLooks));
      // At 0 it stays what it was: a part at the rim of a wall does not flicker.
      part.is_open = part.looks > 0 || (part.looks == 0 && part.is_open);
      if (cost(c) != before) {
        changed_.push_back(c);
        has_changed = true;
      }
    }
  }
  return has_changed;
}

bool RepairedMap::mark_failed(Cell part) {
  if (!parts_.contains(part) || parts_(part).has_failed) {
    return false;
  }
  parts_(part).has_failed = true;
  changed_.push_back(part);
  return true;
}

void RepairedMap::forget_failures() {
  for (Part& part : parts_.values()) {
    part.has_failed = false;
  }
}

CoarseMap RepairedMap::as_map() const {
  Grid<std::uint8_t> occupied{width(), height()};
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    occupied[i] = is_open(occupied.cell_at(i)) ? 0 : 1;
  }
  return {std::move(occupied), drawing_.resolution() / cuts_, drawing_.T_map_grid()};
}

}  // namespace cmn
