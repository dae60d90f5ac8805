// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How far a metre driven is on the drawing.
#pragma once

#include "coarse_map_nav/data/action.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/param_tree.hpp"

#include <memory>
#include <random>
#include <string>
#include <vector>

namespace cmn {

struct MotionModelParams {
  std::string type = "noisy";
  double step_m = kCmnStep_m;
  double scale = 1.0;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("type", self.type, OneOf{{"noisy", "scaled"}},
          "noisy: a step moves a random share of a cell (CMN eq. 1); scaled: by its length");
    visit("step_m", self.step_m, Between{0.02, 2.0},
          "[m] noisy: the length of one forward action, at most one cell of the drawing");
    visit("scale", self.scale, Between{0.1, 10.0},
          "[-] scaled: true size of a cell over the drawing's nominal resolution");
  }
};

/// A move by at most one cell each way, in the axes of the robot's heading: shares of a cell.
struct CellStep {
  double forward = 0.0;  ///< in [-1, 1]
  double left = 0.0;     ///< in [-1, 1]
};

/// A move by a share of a cell, in [0, 1], towards the robot's heading + quarter_turn.
struct Shift {
  int quarter_turn;
  double share;
};
/// Steps as moves along one axis each, without those that are no motion but the rounding of sines.
std::vector<Shift> shifts(const std::vector<CellStep>& steps);

/// Turns a displacement in metres into steps on the drawing. The belief is moved by each in turn.
class MotionModel {
 public:
  virtual ~MotionModel() = default;
  virtual std::vector<CellStep> steps(const Displacement& driven, std::mt19937_64& rng) const = 0;
};

/// CMN's noisy transition: a forward action moves the robot one cell on with probability p and
/// leaves it where it was with 1 - p, p ~ U(0, 1) drawn anew for every action (CMN eq. 1).
///
/// Any other displacement counts as so many actions in its direction as it is steps long, each
/// shortened to fit: one action of exactly `step_m` gives the paper's equation.
class NoisyMotionModel : public MotionModel {
 public:
  explicit NoisyMotionModel(double step_m) : step_m_{step_m} {}
  std::vector<CellStep> steps(const Displacement& driven, std::mt19937_64& rng) const override;

 private:
  double step_m_;
};

/// A displacement is as many cells as its length over the true size of a cell, in whole cells and
/// a remainder that is spread bilinearly (algorithms.md sec. 3, "scaled transition", ours).
class ScaledMotionModel : public MotionModel {
 public:
  /// `cell_m`: the true size of a cell [m].
  explicit ScaledMotionModel(double cell_m) : cell_m_{cell_m} {}
  std::vector<CellStep> steps(const Displacement& driven, std::mt19937_64& rng) const override;

 private:
  double cell_m_;
};

/// `resolution`: the drawing's nominal one [m/cell].
std::unique_ptr<MotionModel> make_motion_model(const MotionModelParams& params, double resolution);

}  // namespace cmn
