// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The discrete Bayes filter on the drawing.
#pragma once

#include "coarse_map_nav/data/belief.hpp"
#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/localization/localizer.hpp"
#include "coarse_map_nav/localization/measurement_model.hpp"
#include "coarse_map_nav/localization/motion_model.hpp"
#include "coarse_map_nav/localization/particle_params.hpp"
#include "coarse_map_nav/localization/scale_filter.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace cmn {

struct LocalizationParams {
  std::string filter = "discrete";
  ScaleFilterParams scaled;
  MotionModelParams motion;
  MeasurementModelParams measurement;
  ParticleParams particles;
  double independence_m = 0.0;
  double converged_confidence = 0.5;
  double contradiction_evidence = 1e-6;
  int reopen_after = 3;
  double reopen_weight = 0.5;
  std::uint32_t seed = 1;
  /// How much of a look is news after a way of `way_m`.
  double news_in(double way_m) const {
    return way_m >= independence_m ? 1.0 : way_m / independence_m;
  }
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit(
        "filter", self.filter, OneOf{{"discrete", "particle", "scaled"}},
        "discrete: a belief over headings and cells (CMN, Robb); particle: poses and local scales "
        "(CMN's baseline MCSE); scaled: scales, headings and cells (ours)");
    visit.group("scaled", self.scaled);
    visit.group("motion", self.motion);
    visit.group("measurement", self.measurement);
    visit.group("particles", self.particles);
    visit("independence_m", self.independence_m, Between{0.0, 10.0},
          "[m] looks so far apart are independent evidence, nearer ones count in proportion; "
          "0: every look counts in full (CMN, Robb)");
    visit("converged_confidence", self.converged_confidence, Between{0.0, 1.0},
          "[-] converged when so much of the belief is within 1 m of the estimate, at its heading");
    visit("contradiction_evidence", self.contradiction_evidence, Between{0.0, 1.0},
          "[-] an observation of a mean likelihood below this contradicts the map");
    visit("reopen_after", self.reopen_after, Between{1, 1000},
          "[observations] contradictions in a row after which the belief is re-opened");
    visit("reopen_weight", self.reopen_weight, Between{0.0, 1.0},
          "[-] share of a uniform belief mixed in then");
    visit("seed", self.seed, Between{0, 4294967295.0},
          "seed of the noisy transition and of the choice between equal estimates");
  }
};

/// Belief over four headings x all cells: predict (CMN eq. 1), correct (CMN eq. 2 and 3).
///
/// The heading of a layer is that of the odometry axis nearest to the robot, as it would lie on the
/// drawing: the robot may stand at any yaw, and what is left over to the axis turns the
/// observation. Mass never enters an occupied cell; mass that faces one stays. After any sequence
/// of calls the belief sums to 1. One step costs a single pass over the belief.
class BeliefFilter : public Localizer {
 public:
  BeliefFilter(CoarseMap map, const LocalizationParams& params);

  /// Starts over, anywhere: uniform over the free cells of all layers.
  void reset() override;
  void reset_heading(Heading heading) override;
  bool reset_near(const Pose2& T_map_robot, double position_sigma_m, double yaw_sigma_rad) override;

  /// Folds in one observation and the odometry since the one before. The first call after a reset
  /// only corrects.
  Correction update(const LocalOccupancy& seen, const Pose2& T_odom_robot) override;
  Localization localization() const override {
    return {belief_, estimate_, middle_of(estimate_.cell), yaw_rad(), confidence_, is_converged()};
  }
  /// The odometry frame jumped (time went back, another bag): the next update only corrects.
  void forget_odometry() { T_odom_last_.reset(); }

  // The two halves of update().
  void predict(const Displacement& driven);
  /// `weight`: how much of the look is news, see LocalizationParams::independence_m.
  Correction correct(const LocalOccupancy& seen, double residual_yaw_rad = 0.0,
                     double weight = 1.0);

  const CoarseMap& map() const override { return map_; }
  const Belief& belief() const { return belief_; }
  /// The most probable state; equals are told apart by a seeded draw, and the one chosen is kept
  /// while it is still among the best (CMN sec. IV-D: "ties are broken randomly").
  const Estimate& estimate() const { return estimate_; }
  /// The probability within 1 m of the estimate, at its heading.
  double confidence() const { return confidence_; }
  bool is_converged() const { return confidence_ >= params_.converged_confidence; }

 private:
  /// The greatest weight in each row of each layer: the best cells are found without another pass.
  using RowPeaks = std::array<std::vector<double>, 4>;
  /// What a cell keeps of its own weight, and takes of the cell's behind it.
  struct Shares {
    double stay = 0.0;
    double come = 0.0;
  };
  /// Moves every layer and, where a likelihood is given, weighs it, then normalises. The layers
  /// have been rolled by `rolled` since the shift was measured. Returns the mean likelihood; where
  /// it does not exceed `least` the belief stays as it was.
  double apply(const Shift& shift, int rolled, const Likelihood* likelihood, double least);
  /// One layer of it, into scratch_ and scratch_peaks_. Returns the sum of its weights.
  double step_layer(Heading heading, Cell step);
  /// With any probability at all.
  HeadingSet possible_headings() const;
  void turn(int quarter_turns);
  void restart(Belief belief);
  void start_from(Belief belief);
  Correction settle(double evidence);
  void summarise();
  /// Of the robot in the axes of the grid: the estimate's heading and what the robot was turned
  /// from the odometry axis at the last update.
  double yaw_rad() const;
  CoarseMap map_;
  LocalizationParams params_;
  std::unique_ptr<MotionModel> motion_;
  std::unique_ptr<MeasurementModel> measurement_;
  std::vector<Shares> shares_;  ///< by kind of cells
  std::mt19937_64 rng_;
  Belief belief_;
  RowPeaks peaks_;
  Belief scratch_;
  RowPeaks scratch_peaks_;
  std::optional<Pose2> T_odom_last_;
  Estimate estimate_;
  double confidence_ = 0.0;
  int contradictions_in_a_row_ = 0;
};

}  // namespace cmn
