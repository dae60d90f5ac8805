// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/local_lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

/// Less gain than this is the noise of a distance field in cells.
constexpr double kGain_m = 0.01;

struct Entry {
  double cost_m;
  std::uint32_t order;  ///< of discovery: equals are settled first come, first served
  LatticeState state;
  bool operator>(const Entry& other) const {
    return std::tie(cost_m, order) > std::tie(other.cost_m, other.order);
  }
};

}  // namespace

void LocalLattice::measure_clearance(const LocalOccupancy& local) {
  cv::Mat free(local.size, local.size, CV_8U);
  for (std::size_t i = 0; i < local.cell_count(); ++i) {
    const bool is_hit = local.confidence[i] > 0.0F && local.occupancy[i] > 0.5F;
    free.data[i] = is_hit ? 0 : 255;
  }
  clearance_.assign(local.cell_count(), 0.0F);
  cv::Mat distance(local.size, local.size, CV_32F, clearance_.data());
  cv::distanceTransform(free, distance, cv::DIST_L2, 5, CV_32F);
}

double LocalLattice::clearance_at(const LocalOccupancy& local, Point2 p_robot) const {
  const int ix = static_cast<int>(std::floor(p_robot.x / local.resolution + 0.5 * local.size));
  const int iy = static_cast<int>(std::floor(p_robot.y / local.resolution + 0.5 * local.size));
  if (ix < 0 || iy < 0 || ix >= local.size || iy >= local.size) {
    return -1.0;
  }
  const std::size_t i = local.index_of(ix, iy);
  if (local.confidence[i] <= 0.0F) {
    return -1.0;
  }
  // From the middle of a cell to the border, not the middle, of the occupied one.
  return std::max(0.0, static_cast<double>(clearance_[i]) - 0.5) * local.resolution;
}

bool LocalLattice::may_step(const LocalOccupancy& local, Point2 from, Point2 to) const {
  const double start_m = clearance_at(local, from);
  const double middle_m = clearance_at(local, 0.5 * (from + to));
  const double end_m = clearance_at(local, to);
  if (middle_m < 0.0 || end_m < 0.0) {
    return false;
  }
  if (middle_m >= params_.clearance_m && end_m >= params_.clearance_m) {
    return true;
  }
  return start_m < params_.clearance_m && middle_m >= start_m && end_m > start_m + kGain_m;
}

const std::vector<LatticeState>& LocalLattice::search(const LocalOccupancy& local,
                                                      bool may_go_forward) {
  measure_clearance(local);
  const double reach_m = std::min(params_.reach_m, 0.5 * local.side_m());
  const int reach = static_cast<int>(std::floor(reach_m / step_m_));
  const int side = 2 * reach + 1;
  std::vector<char> is_settled(static_cast<std::size_t>(side * side * 4), 0);
  const auto slot_of = [&](const LatticeState& s) {
    return static_cast<std::size_t>(((s.offset.y + reach) * side + s.offset.x + reach) * 4 +
                                    s.quarter_turns);
  };

  settled_.clear();
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::uint32_t order = 0;
  open.push({0.0, order, LatticeState{}});
  while (!open.empty()) {
    const LatticeState here = open.top().state;
    open.pop();
    if (is_settled[slot_of(here)] != 0) {
      continue;
    }
    is_settled[slot_of(here)] = 1;
    const auto parent = static_cast<std::int32_t>(settled_.size());
    settled_.push_back(here);
    const auto offer = [&](Cell offset, int quarter_turns, double cost_m, ActionType action) {
      const LatticeState next{offset, ((quarter_turns % 4) + 4) % 4, here.cost_m + cost_m, parent,
                              action};
      if (is_settled[slot_of(next)] == 0) {
        open.push({next.cost_m, ++order, next});
      }
    };
    const Cell ahead = here.offset + turned(Cell{1, 0}, here.quarter_turns);
    const bool is_first_step = parent == 0;
    if (std::abs(ahead.x) <= reach && std::abs(ahead.y) <= reach &&
        (may_go_forward || !is_first_step) &&
        may_step(local, position_of(here), {ahead.x * step_m_, ahead.y * step_m_})) {
      offer(ahead, here.quarter_turns, step_m_, ActionType::kMoveForward);
    }
    offer(here.offset, here.quarter_turns + 1, params_.turn_cost_m, ActionType::kTurnLeft);
    offer(here.offset, here.quarter_turns - 1, params_.turn_cost_m, ActionType::kTurnRight);
  }
  return settled_;
}

std::vector<ActionType> LocalLattice::actions_to(std::size_t state) const {
  std::vector<ActionType> actions;
  for (auto i = static_cast<std::int32_t>(state); settled_[static_cast<std::size_t>(i)].parent >= 0;
       i = settled_[static_cast<std::size_t>(i)].parent) {
    actions.push_back(settled_[static_cast<std::size_t>(i)].action);
  }
  std::reverse(actions.begin(), actions.end());
  return actions;
}

ActionType LocalLattice::first_action(std::size_t state) const {
  ActionType action = ActionType::kStop;
  for (auto i = static_cast<std::int32_t>(state); settled_[static_cast<std::size_t>(i)].parent >= 0;
       i = settled_[static_cast<std::size_t>(i)].parent) {
    action = settled_[static_cast<std::size_t>(i)].action;
  }
  return action;
}

}  // namespace cmn
