// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/map_repair.hpp"

#include <algorithm>
#include <cmath>

namespace cmn {
namespace {

constexpr int kFailedCost = 200;

}  // namespace

RepairedMap::RepairedMap(const CoarseMap& drawing, const MapRepairParams& params)
    : drawing_{drawing},
      params_{params},
      cuts_{std::max(1, static_cast<int>(std::ceil(drawing.resolution() / params.cell_m - 1e-6)))},
      state_{drawing.width() * cuts_, drawing.height() * cuts_},
      cost_of_{1, params.drawn_wall_cost, 1, params.seen_wall_cost, kFailedCost} {
  forget();
}

Cell RepairedMap::part_of(Point2 position_cells) const {
  return {static_cast<int>(std::floor(position_cells.x * cuts_)),
          static_cast<int>(std::floor(position_cells.y * cuts_))};
}

void RepairedMap::forget() {
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const Cell part = state_.cell_at(i);
    const bool is_free = drawing_.is_free({part.x / cuts_, part.y / cuts_});
    state_[i] = is_free ? kDrawnFree : kDrawnWall;
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
      Tally& tally =
          tally_of({static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))});
      const double clear_m = clearance.at_cell(local.index_of(ix, iy));
      ++tally.pixels;
      tally.known += clear_m >= 0.0;
      tally.drivable += clear_m >= least_clearance_m;
    }
  }
  // A part at the rim of the view is judged by what of it is in view, if that is most of it.
  const double whole = 1.0 / (pixel * pixel);
  bool has_changed = false;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Cell part = low + Cell{x, y};
      const Tally& tally = tally_of(part);
      if (tally.known == 0 || !state_.contains(part) || state_(part) == kFailed) {
        continue;
      }
      std::uint8_t& state = state_(part);
      const std::uint8_t before = state;
      if (tally.drivable >= params_.open_share * whole) {
        state = kSeenOpen;
      } else if (tally.known >= params_.known_share * whole) {
        state = kSeenWall;
      }
      has_changed |= cost_of_[state] != cost_of_[before];
    }
  }
  return has_changed;
}

bool RepairedMap::mark_failed(Cell part) {
  if (!state_.contains(part) || state_(part) == kFailed) {
    return false;
  }
  state_(part) = kFailed;
  return true;
}

void RepairedMap::forget_failures() {
  std::replace(state_.values().begin(), state_.values().end(), std::uint8_t{kFailed},
               std::uint8_t{kSeenWall});
}

CoarseMap RepairedMap::as_map() const {
  Grid<std::uint8_t> occupied{width(), height()};
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    occupied[i] = cost_of_[state_[i]] == 1 ? 0 : 1;
  }
  return {std::move(occupied), drawing_.resolution() / cuts_, drawing_.T_map_grid()};
}

}  // namespace cmn
