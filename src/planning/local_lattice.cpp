// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/local_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr double kImpossible = std::numeric_limits<double>::infinity();
/// Less gain than this is the noise of a distance field in cells.
constexpr double kGain_m = 0.01;
constexpr double kUnit_m = 0.005;  ///< costs are queued in whole units

std::size_t units(double cost_m) { return static_cast<std::size_t>(std::lround(cost_m / kUnit_m)); }

}  // namespace

void ClearanceMap::measure(const LocalOccupancy& local) {
  size_ = local.size;
  resolution_ = local.resolution;
  cv::Mat free(size_, size_, CV_8U);
  is_seen_.resize(local.cell_count());
  for (std::size_t i = 0; i < local.cell_count(); ++i) {
    is_seen_[i] = local.confidence[i] > 0.0F;
    free.data[i] = is_seen_[i] != 0 && local.occupancy[i] > 0.5F ? 0 : 255;
  }
  clearance_m_.resize(local.cell_count());
  cv::Mat clearance(size_, size_, CV_32F, clearance_m_.data());
  cv::distanceTransform(free, clearance, cv::DIST_L2, 5, CV_32F);
  // From the middle of a cell to the border, not the middle, of the occupied one.
  for (float& distance : clearance_m_) {
    distance = std::max(0.0F, distance - 0.5F) * static_cast<float>(resolution_);
  }
}

double ClearanceMap::at(Point2 p_robot) const {
  const int ix = static_cast<int>(std::floor(p_robot.x / resolution_ + 0.5 * size_));
  const int iy = static_cast<int>(std::floor(p_robot.y / resolution_ + 0.5 * size_));
  return ix < 0 || iy < 0 || ix >= size_ || iy >= size_
             ? kUnseen
             : at_cell(static_cast<std::size_t>(iy) * static_cast<std::size_t>(size_) +
                       static_cast<std::size_t>(ix));
}

double LocalLattice::step_cost_m(Cell from, Cell to) const {
  const Point2 start{from.x * step_m_, from.y * step_m_};
  const Point2 end{to.x * step_m_, to.y * step_m_};
  const double start_m = clearance_.at(start);
  const double middle_m = clearance_.at(0.5 * (start + end));
  const double end_m = clearance_.at(end);
  const double least_m = std::min(middle_m, end_m);
  const bool leaves_narrowness =
      start_m < params_.clearance_m && middle_m >= start_m && end_m > start_m + kGain_m;
  if (least_m < 0.0 || (least_m < params_.clearance_m && !leaves_narrowness)) {
    return kImpossible;
  }
  const double slack_m = std::max(params_.comfort_m - params_.clearance_m, 1e-6);
  const double nearness = std::clamp((params_.comfort_m - least_m) / slack_m, 0.0, 1.0);
  return step_m_ * (1.0 + params_.discomfort * nearness);
}

const std::vector<LatticeState>& LocalLattice::search(const LocalOccupancy& local,
                                                      bool may_go_forward) {
  clearance_.measure(local);
  const double reach_m = std::min(params_.reach_m, 0.5 * local.side_m());
  const int reach = static_cast<int>(std::floor(reach_m / step_m_));
  const int side = 2 * reach + 1;
  const auto slot_of = [&](Cell offset, int quarter_turns) {
    return static_cast<std::size_t>(((offset.y + reach) * side + offset.x + reach) * 4 +
                                    quarter_turns);
  };
  constexpr auto kFar = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> cost(static_cast<std::size_t>(side * side * 4), kFar);

  // Dial's queue: the longest edge bounds how many buckets are in use at a time.
  const std::size_t turn = units(params_.turn_cost_m);
  const std::size_t longest = std::max(turn, units(step_m_ * (1.0 + params_.discomfort))) + 1;
  std::vector<std::vector<LatticeState>> buckets(longest + 1);
  std::size_t waiting = 0;
  const auto offer = [&](const LatticeState& state, std::size_t total) {
    std::size_t& known = cost[slot_of(state.offset, state.quarter_turns)];
    if (total < known) {  // the first of equals stays
      known = total;
      buckets[total % buckets.size()].push_back(state);
      ++waiting;
    }
  };
  states_.clear();
  offer(LatticeState{}, 0);
  for (std::size_t total = 0; waiting > 0; ++total) {
    std::vector<LatticeState>& bucket = buckets[total % buckets.size()];
    // Turns may be free: the bucket grows while it is worked off.
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      LatticeState here = bucket[i];
      --waiting;
      if (cost[slot_of(here.offset, here.quarter_turns)] != total) {
        continue;  // a cheaper way was found since
      }
      here.cost_m = static_cast<double>(total) * kUnit_m;
      const auto parent = static_cast<std::int32_t>(states_.size());
      states_.push_back(here);
      const Cell ahead = here.offset + turned(Cell{1, 0}, here.quarter_turns);
      if (std::abs(ahead.x) <= reach && std::abs(ahead.y) <= reach &&
          (may_go_forward || parent != 0)) {
        const double step = step_cost_m(here.offset, ahead);
        if (step < kImpossible) {
          offer({ahead, here.quarter_turns, 0.0, parent, ActionType::kMoveForward},
                total + units(step));
        }
      }
      offer({here.offset, (here.quarter_turns + 1) % 4, 0.0, parent, ActionType::kTurnLeft},
            total + turn);
      offer({here.offset, (here.quarter_turns + 3) % 4, 0.0, parent, ActionType::kTurnRight},
            total + turn);
    }
    bucket.clear();
  }
  return states_;
}

ActionType LocalLattice::first_action(std::size_t state) const {
  ActionType action = ActionType::kStop;
  for (auto i = static_cast<std::int32_t>(state); states_[static_cast<std::size_t>(i)].parent >= 0;
       i = states_[static_cast<std::size_t>(i)].parent) {
    action = states_[static_cast<std::size_t>(i)].action;
  }
  return action;
}

}  // namespace cmn
