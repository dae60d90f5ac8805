// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/local_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cmn {
namespace {

constexpr double kImpossible = std::numeric_limits<double>::infinity();
/// Less gain than this is the noise of a distance field in cells.
constexpr double kGain_m = 0.01;
constexpr double kUnit_m = 0.005;  ///< costs are queued in whole units

/// Less ground than that is a pocket and no room.
constexpr double kPocketM2 = 0.2;

std::uint32_t units(double cost_m) {
  return static_cast<std::uint32_t>(std::lround(cost_m / kUnit_m));
}

}  // namespace

double LocalLattice::clearance_at(Cell half_steps) const {
  const int ix = column_of_half_step_[static_cast<std::size_t>(half_steps.x + 2 * reach_)];
  const int iy = column_of_half_step_[static_cast<std::size_t>(half_steps.y + 2 * reach_)];
  return ix < 0 || iy < 0 || ix >= clearance_.size() || iy >= clearance_.size()
             ? ClearanceMap::kUnseen
             : clearance_.at_cell(ix, iy);
}

double LocalLattice::step_cost_m(Cell from, Cell to, double clearance_m) const {
  const double start_m = clearance_at(2 * from);
  const double middle_m = clearance_at(from + to);
  const double end_m = clearance_at(2 * to);
  const double least_m = std::min(middle_m, end_m);
  const bool leaves_narrowness =
      start_m < clearance_m && middle_m >= start_m && end_m > start_m + kGain_m;
  if (least_m < 0.0 || (least_m < clearance_m && !leaves_narrowness)) {
    return kImpossible;
  }
  const double slack_m = std::max(params_.comfort_m - params_.clearance_m, 1e-6);
  const double nearness = std::clamp((params_.comfort_m - least_m) / slack_m, 0.0, 1.0);
  return step_m_ * (1.0 + params_.discomfort * nearness);
}

void LocalLattice::look_at(const LocalOccupancy& local) {
  // Farther than that, a clearance is compared with nothing.
  clearance_.measure(local, std::max(params_.clearance_m, params_.comfort_m) + 2.0 * kGain_m);
  const double reach_m = std::min(params_.reach_m, 0.5 * local.side_m());
  reach_ = static_cast<int>(std::floor(reach_m / step_m_));
  column_of_half_step_.clear();
  for (int i = -2 * reach_; i <= 2 * reach_; ++i) {
    const int before = (i - (i % 2 != 0)) / 2;
    const int after = (i + (i % 2 != 0)) / 2;
    column_of_half_step_.push_back(
        clearance_.column_of(0.5 * (before * step_m_ + after * step_m_)));
  }
}

const std::vector<LatticeState>& LocalLattice::search(const LocalOccupancy& local,
                                                      bool may_go_forward) {
  look_at(local);
  for (const double share : {1.0, 0.5, 0.25}) {
    search_with(share * params_.clearance_m, may_go_forward);
    if (static_cast<double>(places_.size()) * step_m_ * step_m_ > kPocketM2) {
      break;
    }
  }
  return states_;
}

void LocalLattice::search_with(double clearance_m, bool may_go_forward) {
  const int side = 2 * reach_ + 1;
  const auto place_of = [&](Cell offset) {
    return static_cast<std::size_t>((offset.y + reach_) * side + offset.x + reach_);
  };
  constexpr auto kFar = std::numeric_limits<std::uint32_t>::max();
  const auto places = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  cost_.assign(4 * places, kFar);
  is_found_.assign(places, 0);

  // Dial's queue: the longest edge bounds how many buckets are in use at a time.
  const std::uint32_t turn = units(params_.turn_cost_m);
  const std::uint32_t longest = std::max(turn, units(step_m_ * (1.0 + params_.discomfort))) + 1;
  buckets_.resize(longest + 1);
  std::size_t waiting = 0;
  const auto offer = [&](const LatticeState& state, std::uint32_t total) {
    std::uint32_t& known =
        cost_[4 * place_of(state.offset) + static_cast<std::size_t>(state.quarter_turns)];
    if (total < known) {  // the first of equals stays
      known = total;
      buckets_[total % buckets_.size()].push_back(state);
      ++waiting;
    }
  };
  states_.clear();
  places_.clear();
  offer(LatticeState{}, 0);
  for (std::uint32_t total = 0; waiting > 0; ++total) {
    std::vector<LatticeState>& bucket = buckets_[total % buckets_.size()];
    // Turns may be free: the bucket grows while it is worked off.
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      LatticeState here = bucket[i];
      --waiting;
      const std::size_t place = place_of(here.offset);
      if (cost_[4 * place + static_cast<std::size_t>(here.quarter_turns)] != total) {
        continue;  // a cheaper way was found since
      }
      here.cost_m = static_cast<double>(total) * kUnit_m;
      const auto parent = static_cast<std::int32_t>(states_.size());
      if (is_found_[place] == 0) {
        is_found_[place] = 1;
        places_.push_back(states_.size());
      }
      states_.push_back(here);
      const Cell ahead = here.offset + turned(Cell{1, 0}, here.quarter_turns);
      if (std::abs(ahead.x) <= reach_ && std::abs(ahead.y) <= reach_ &&
          (may_go_forward || parent != 0)) {
        const double step = step_cost_m(here.offset, ahead, clearance_m);
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
