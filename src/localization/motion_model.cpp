// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/motion_model.hpp"

#include "coarse_map_nav/data/random.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace cmn {
namespace {

/// Less than this share of a cell is no motion; each motion costs a pass over the belief.
constexpr double kNoShare = 1e-12;

}  // namespace

std::vector<Shift> shifts(const std::vector<CellStep>& steps) {
  std::vector<Shift> shifts;
  for (const CellStep& step : steps) {
    if (std::abs(step.forward) > kNoShare) {
      shifts.push_back({step.forward > 0.0 ? 0 : 2, std::abs(step.forward)});
    }
    if (std::abs(step.left) > kNoShare) {
      shifts.push_back({step.left > 0.0 ? 1 : 3, std::abs(step.left)});
    }
  }
  return shifts;
}

std::vector<CellStep> NoisyMotionModel::steps(const Displacement& driven,
                                              std::mt19937_64& rng) const {
  const double actions = std::hypot(driven.forward_m, driven.left_m) / step_m_;
  if (actions == 0.0) {
    return {};
  }
  // A real base ends a little before or behind its mark: up to a quarter more is still one action.
  const double count = std::max(1.0, std::ceil(actions - 0.25));
  const double share = std::min(1.0, actions / count);
  const double length_m = actions * step_m_;
  std::vector<CellStep> steps;
  for (int i = 0; i < static_cast<int>(count); ++i) {
    const double p = share * draw_uniform(rng);
    steps.push_back({p * driven.forward_m / length_m, p * driven.left_m / length_m});
  }
  return steps;
}

std::vector<CellStep> ScaledMotionModel::steps(const Displacement& driven,
                                               std::mt19937_64& /*rng*/) const {
  double forward = driven.forward_m / cell_m_;
  double left = driven.left_m / cell_m_;
  std::vector<CellStep> steps;
  while (forward != 0.0 || left != 0.0) {
    const CellStep step{std::clamp(forward, -1.0, 1.0), std::clamp(left, -1.0, 1.0)};
    steps.push_back(step);
    forward -= step.forward;
    left -= step.left;
  }
  return steps;
}

std::unique_ptr<MotionModel> make_motion_model(const MotionModelParams& params, double resolution) {
  if (params.type == "noisy") {
    return std::make_unique<NoisyMotionModel>(params.step_m);
  }
  assert(params.type == "scaled");  // the parameter walk admits no other word
  return std::make_unique<ScaledMotionModel>(params.scale * resolution);
}

}  // namespace cmn
