// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Monte Carlo localization on a drawing whose scale is not known.
#pragma once

#include "coarse_map_nav/data/belief.hpp"
#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/localization/belief_filter.hpp"
#include "coarse_map_nav/localization/localizer.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

namespace cmn {

/// One guess of where the robot is, and of how large the drawing is there.
struct Particle {
  Point2 position;      ///< [cells] of the grid, cell (0, 0) from 0 to 1
  double yaw = 0.0;     ///< [rad] of the robot, in the grid's axes
  double scale = 1.0;   ///< true size of a cell over the nominal resolution
  double weight = 0.0;  ///< all together sum to 1
};

/// Particles over pose and local scale of the drawing: CMN's baseline MCSE, after Behzadian et al.
/// 2015, "Monte Carlo localization in hand-drawn maps", and Boniardi et al. 2015, "Robot navigation
/// in hand-drawn sketched maps". CMN sec. V-C: "a particle filter is used to estimate the scale of
/// local deformations in the coarse map. This estimate informs the transition probabilities and the
/// observation model." It says no more than that; the rest is ours.
///
/// Predict: the odometry's displacement, over the particle's scale, with noise; the scale itself
/// walks at random. A particle does not enter an occupied cell: it slides along it.
/// Correct: weight *= (1 - MSE)^exponent between the observation and the piece of the drawing that
/// the robot would see from the particle at its scale (Robb, "Continuous").
/// Low-variance resampling (Thrun et al. 2005, Table 4.4) when the effective number of particles
/// falls below a half.
///
/// To the outside it is a belief over cells and headings: the particles' weights, each in its cell
/// and at the odometry axis nearest to it, as in BeliefFilter. The estimate is the most probable
/// place of 3 x 3 cells. A step costs O(particles * window cells).
class ParticleFilter : public Localizer {
 public:
  ParticleFilter(const CoarseMap& map, const LocalizationParams& params);

  /// Along any of the drawing's axes, at any scale.
  void reset() override;
  void reset_heading(Heading heading) override;
  bool reset_near(const Pose2& T_map_robot, double position_sigma_m, double yaw_sigma_rad) override;

  Correction update(const LocalOccupancy& seen, const Pose2& T_odom_robot) override;
  Localization localization() const override {
    return {belief_,     estimate_,   position_cells_,
            yaw_rad_,    confidence_, confidence_ >= params_.converged_confidence,
            1.0 / scale_};
  }

  // The halves of update(); the belief follows only in update().
  /// `T_start_end`: what odometry says was driven, in the frame of the start pose.
  void predict(const Pose2& T_start_end);
  /// `weight`: how much of the look is news. The mean likelihood; where it does not exceed
  /// `contradiction_evidence` the weights stay as they were.
  double correct(const LocalOccupancy& seen, double weight = 1.0);

  const std::vector<Particle>& particles() const { return particles_; }
  const CoarseMap& map() const override { return map_; }
  /// True size of a cell over the nominal resolution near the estimate: the mean.
  double scale() const { return scale_; }

 private:
  bool is_free(Point2 p) const { return is_occupied_[slot_of(p)] == 0; }
  /// Of a point that lies no farther outside of the map than the margin.
  std::size_t slot_of(Point2 p) const {
    return static_cast<std::size_t>(static_cast<int>(p.y + margin_) * stride_ +
                                    static_cast<int>(p.x + margin_));
  }
  Point2 anywhere(double share);
  void start(std::optional<Heading> heading);
  void restart();
  double any_scale();
  void resample();
  /// Puts this share of the particles anywhere.
  void renew(double share, bool is_heading_lost);
  /// What the particles say, as a belief.
  void publish(double residual_yaw_rad);

  CoarseMap map_;
  LocalizationParams params_;
  std::mt19937_64 rng_;
  std::vector<Cell> free_cells_;
  /// With a margin of occupied cells all around, wider than any window.
  std::vector<std::uint8_t> is_occupied_;
  int margin_;
  int stride_;
  std::vector<Particle> particles_;
  std::vector<Particle> scratch_;
  std::vector<double> likelihoods_;
  std::optional<Pose2> T_odom_last_;
  int contradictions_in_a_row_ = 0;
  Belief belief_;
  std::vector<Estimate> occupied_states_;  ///< those of the belief that are not 0
  Estimate estimate_;
  Point2 position_cells_;
  double yaw_rad_ = 0.0;
  double scale_ = 1.0;
  double confidence_ = 0.0;
};

}  // namespace cmn
