// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Ours: a belief over scale x heading x cell, from all that the sensor reaches.
#pragma once

#include "coarse_map_nav/data/belief.hpp"
#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/localization/localizer.hpp"
#include "coarse_map_nav/localization/range_table.hpp"
#include "coarse_map_nav/localization/wall_compass.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace cmn {

struct ScaleFilterParams {
  WallCompassParams compass;
  double reach_m = 8.0;
  int scales = 1;
  double least_scale = 0.7;
  double greatest_scale = 1.4;
  double scale_drift = 0.0;
  double range_weight = 10.0;
  double range_sigma = 0.12;
  double range_short = 0.25;
  double range_random = 0.08;
  double field_weight = 1.5;
  double field_sigma_m = 0.3;
  double field_random = 0.3;
  double free_weight = 4.0;
  double independence_m = 0.8;
  double rim_penalty = 0.3;
  double diffusion = 0.1;
  double blocked_share = 0.3;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit.group("compass", self.compass);
    visit("reach_m", self.reach_m, Between{0.5, 100.0}, "[m] rays are compared up to this range");
    visit("scales", self.scales, Between{1, 32},
          "how many scales of the drawing are believed in, evenly spaced in log; 1: the nominal");
    visit("least_scale", self.least_scale, Between{0.1, 10.0},
          "[-] drawn metres a metre, at least");
    visit("greatest_scale", self.greatest_scale, Between{0.1, 10.0}, "[-] and at most");
    visit("scale_drift", self.scale_drift, Between{0.0, 1.0},
          "[1/m] share of a scale's belief that goes over to each neighbour per metre");
    visit("range_weight", self.range_weight, Between{0.0, 200.0},
          "[-] range model: the mean over the bearings counts as so many independent ranges");
    visit("range_sigma", self.range_sigma, Between{0.01, 2.0},
          "[-] range model: standard deviation of the log of seen over expected range");
    visit("range_short", self.range_short, Between{0.0, 1.0},
          "[-] range model: share of a perfect match that a range shorter than expected is worth");
    visit("range_random", self.range_random, Between{1e-6, 1.0},
          "[-] range model: likewise of any range whatever");
    visit("field_weight", self.field_weight, Between{0.0, 200.0},
          "[-] likelihood field: the mean over the hits counts as so many independent ones");
    visit("field_sigma_m", self.field_sigma_m, Between{0.01, 5.0},
          "[m] likelihood field: standard deviation of the distance to what is drawn");
    visit("field_random", self.field_random, Between{1e-6, 1.0},
          "[-] likelihood field: floor of a hit far from everything drawn");
    visit("free_weight", self.free_weight, Between{0.0, 200.0},
          "[-] price of a look whose free rays lie all on what is drawn as occupied");
    visit("independence_m", self.independence_m, Between{0.01, 10.0},
          "[m] looks so far apart are independent, nearer ones count in proportion");
    visit("rim_penalty", self.rim_penalty, Between{0.0, 1.0},
          "[-] likelihood of standing on an occupied cell beside a free one, per look");
    visit("diffusion", self.diffusion, Between{0.0, 5.0},
          "[1/m] share of a cell's belief that goes over to each neighbour per metre driven");
    visit("blocked_share", self.blocked_share, Between{0.0, 1.0},
          "[-] so much of the belief that would have to pass a drawn wall stays before it");
  }
};

/// Differences to BeliefFilter (the papers'):
///  - A look is compared over the whole range of the sensor, not over three cells: by a range model
///    in the log of the range, where a wrong scale is a mere offset and clutter that the drawing
///    lacks is cheap, and by a likelihood field (Thrun et al. 2005, ch. 6), where hits must lie
///    near something drawn and free rays must not. Neither is enough alone.
///  - The grid of hypotheses rides along with the robot: odometry moves it as a whole, and mass
///    changes its cell only when the grid has moved by one. So motion alone does not blur.
///  - Layers stand for how the drawing lies in the odometry, and not for the robot's heading: they
///    do not roll. The odometry's axes are held to the walls by WallCompass.
///  - Work and memory traffic follow the support of the belief.
class ScaleFilter : public Localizer {
 public:
  /// `converged_confidence` as in LocalizationParams.
  ScaleFilter(const CoarseMap& map, const ScaleFilterParams& params, double converged_confidence);

  void reset();
  void reset_heading(Heading heading) override;
  Correction update(const LocalOccupancy& seen, const Pose2& T_odom_robot) override;
  Localization localization() const override;

  /// P(scale), in the order of scale_of().
  std::vector<double> scale_marginal() const;
  double scale_of(int i) const { return sheets_[static_cast<std::size_t>(i)].scale; }

 private:
  /// All hypotheses of one scale.
  struct Sheet {
    double scale = 1.0;
    Point2 offset;  ///< of every hypothesis from the middle of its cell, in the odometry's axes
                    ///< [cells]
    std::array<std::vector<float>, 4> weight;           ///< by how the drawing lies; padded
    std::array<std::vector<std::uint32_t>, 4> support;  ///< cells of weight > 0
  };
  /// What a look says about the cells of one sheet and layer.
  struct Evidence {
    std::array<std::array<float, 256>, kBearings>
        by_code;                       ///< [bearing of the look][expected range]
    std::vector<std::ptrdiff_t> hits;  ///< offsets in the padded planes
    std::vector<std::ptrdiff_t> frees;
  };
  void move(Sheet& sheet, Point2 driven_m);
  void shift(Sheet& sheet, int layer, Cell by);
  void diffuse(Sheet& sheet, int layer, double share);
  void drift_between_scales(double share);
  /// Weighs all cells; false when nothing is left.
  bool weigh(const RayProfile& rays, double news);
  Evidence evidence(const RayProfile& rays, const Sheet& sheet, int layer) const;
  double log_likelihood(const Evidence& evidence, int layer, std::uint32_t cell) const;
  void normalise(double total);
  void summarise();
  void start(const std::array<double, 4>& heading_weights);

  std::ptrdiff_t plane_index(std::uint32_t padded_index) const;
  Cell cell_of(std::uint32_t padded_index) const;

  CoarseMap map_;
  ScaleFilterParams params_;
  double converged_confidence_;
  LogRange code_;
  RangeTable table_;
  int stride_ = 0;        ///< of the padded layers
  int plane_margin_ = 0;  ///< [cells] of the planes below, so that no ray leaves them
  int plane_stride_ = 0;
  std::vector<float> field_;  ///< log(exp(-d^2 / 2 sigma^2) + random), d to the nearest drawn wall
  std::vector<float> occupied_;  ///< 0 or 1
  std::vector<Sheet> sheets_;
  std::vector<float> scratch_;
  std::vector<std::uint32_t> scratch_support_;
  WallCompass compass_;
  std::optional<Point2> p_odom_last_;
  Belief belief_;  ///< scales summed out, layers by the robot's heading
  std::vector<std::pair<Heading, std::uint32_t>> shown_;  ///< cells of belief_ that are not 0
  Estimate estimate_;
  Point2 position_cells_;
  double yaw_rad_ = 0.0;
  double scale_ = 1.0;
  double confidence_ = 0.0;
};

}  // namespace cmn
