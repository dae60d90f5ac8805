// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Ours: LocalOccupancy and odometry -> a belief over scale x direction x cell.
#pragma once

#include "coarse_map_nav/data/belief.hpp"
#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/look_contradiction.hpp"
#include "coarse_map_nav/localization/hit_field.hpp"
#include "coarse_map_nav/localization/localizer.hpp"
#include "coarse_map_nav/localization/range_looks.hpp"
#include "coarse_map_nav/localization/range_model.hpp"
#include "coarse_map_nav/localization/scale_filter_params.hpp"
#include "coarse_map_nav/localization/wall_compass.hpp"
#include "coarse_map_nav/localization/weight_layer.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace cmn {

/// Differences to BeliefFilter (the papers'):
///  - A look is compared over the whole range of the sensor, not over three cells: by a range model
///    in the log of the range, where a wrong scale is a mere offset and clutter that the drawing
///    lacks is cheap, and by a likelihood field (Thrun et al. 2005, ch. 6), where hits must lie
///    near something drawn and free rays must not.
///  - The grid of hypotheses rides along with the robot: odometry moves it as a whole, and mass
///    changes its cell only when the grid has moved by one. So motion alone does not blur.
///  - Layers stand for how the drawing lies in the odometry, and not for the robot's heading: they
///    do not roll. The odometry's axes are held to the walls by WallCompass.
///  - The drawing may be turned against them by less than a quarter too (`headings` > 4): the rays
///    are cast, and odometry is taken, in axes that are turned likewise, for each such turn. The
///    belief that is handed out counts each direction to its nearest heading.
///  - Hypotheses may lie nearer together than cells: by parts of a cell. The belief that is handed
///    out sums them up.
///  - Work and memory traffic follow the support of the belief.
class ScaleFilter : public Localizer {
 public:
  /// `converged_confidence` as in LocalizationParams.
  ScaleFilter(const CoarseMap& map, const ScaleFilterParams& params, double converged_confidence);

  void reset() override;
  void reset_heading(Heading heading) override;
  bool reset_near(const Pose2& T_map_robot, double position_sigma_m, double yaw_sigma_rad) override;
  const CoarseMap& map() const override { return map_; }
  Correction update(const LocalOccupancy& seen, const Pose2& T_odom_robot) override;
  Localization localization() const override;

  /// P(scale), in the order of scale_of().
  std::vector<double> scale_marginal() const;
  /// P(turn), quarter turns summed out, in the order of turn_of().
  std::vector<double> turn_marginal() const;
  /// Mean log likelihood of the rays at the best hypothesis, over the way [nats]; 0: all fits.
  double fit() const { return fit_; }
  double scale_of(int i) const { return sheets_[static_cast<std::size_t>(i * turns())].scale; }
  /// How far the axes of the drawing may be turned from those that the robot keeps to: evenly
  /// spaced in (-pi/4, pi/4], rising, 0 among them.
  double turn_of(int j) const { return sheets_[static_cast<std::size_t>(j)].turn_rad; }

 private:
  /// All hypotheses of one scale and one turn.
  struct Sheet {
    double scale = 1.0;
    double turn_rad = 0.0;  ///< on the drawing, beyond its yaw in the walls' axes and quarters
    Point2 offset;  ///< of every hypothesis from the middle of its part, in the walls' axes turned
                    ///< back by turn_rad [parts]
    std::array<WeightLayer, 4> layers;  ///< by how the drawing lies; padded
  };
  /// What a look says about the parts of one sheet and layer.
  struct Evidence {
    std::array<std::array<float, 256>, kBearings>
        by_code;                       ///< [bearing of the look][expected range]
    std::vector<std::ptrdiff_t> hits;  ///< offsets in the field
    std::vector<std::ptrdiff_t> frees;
  };
  /// More states than one in so many parts are many: they are not listed.
  std::size_t most_listed() const { return parts_.map().occupied().size() / 8; }
  int turns() const { return params_.headings / 4; }
  /// The heading on the drawing that is nearest to the robot's by the hypotheses of a layer.
  Heading heading_of(const Sheet& sheet, int layer) const {
    return turned(static_cast<Heading>(layer), nearest_quarter(yaw_rad_ + sheet.turn_rad));
  }
  void move(Sheet& sheet, Point2 driven_m);
  void shift(WeightLayer& layer, Cell by);
  void diffuse(WeightLayer& layer, double share);
  /// Weighs all cells; false when nothing is left. `yaw_rad`: of the robot, in the walls' axes.
  bool weigh(const LocalOccupancy& seen, double yaw_rad, double news);
  Evidence evidence(const RayProfile& rays, const Sheet& sheet, int layer) const;
  /// Of what a look says of one part; `is_free`: the part, where it is not at the rim.
  double together(const Evidence& evidence, float range, float hits, float frees,
                  bool is_free) const;
  double log_likelihood(const Evidence& evidence, int layer, std::uint32_t part) const;
  /// The same for all parts that hold a weight: tell(part, log likelihood), which may change it.
  template <class Tell>
  void measure_rows(const Evidence& evidence, int layer, const WeightLayer& weights,
                    Tell&& tell) const;
  double range_log_likelihood(const Evidence& evidence, int layer, std::uint32_t part) const;
  void normalise(double total);
  void forget_shown();
  void list_shown(Heading heading, std::size_t i);
  void summarise();
  WeightLayer no_weights() const;
  /// Of a state: its layer's heading, the turn beyond it, its part.
  using Weights = std::function<double(Heading, double turn_rad, Cell)>;
  /// Layers are taken to be headings until the first look tells how the odometry lies.
  void start(const Weights& weight_of);
  /// That: each state is now `yaw_rad` less.
  void turn_back(double yaw_rad);
  /// Adds `each` times the weights, and the priors of scale and rim, to all sheets; returns the
  /// sum.
  double spread(const Weights& weight_of, double each);
  /// Nothing fits: anywhere is possible again.
  void reopen();

  CoarseMap map_;
  ScaleFilterParams params_;
  std::shared_ptr<const RangeModel> model_;
  const MapParts& parts_;
  RangeLooks looks_;
  double converged_confidence_;
  HitField field_;
  double log_of_rim_ = 0.0;
  std::vector<Sheet> sheets_;  ///< all turns of the first scale, of the second, ...
  WeightLayer scratch_;
  WallCompass compass_;
  std::optional<Point2> p_odom_last_;
  LookComparison comparison_;
  Belief belief_;  ///< scales and turns summed out, layers by the robot's heading
  std::vector<std::pair<Heading, std::uint32_t>> shown_;  ///< cells of belief_ that are not 0,
  bool is_shown_listed_ = true;                           ///< while they are few
  Estimate estimate_;
  Point2 position_cells_;
  double yaw_rad_ = 0.0;       ///< of the robot in the walls' axes
  double grid_yaw_rad_ = 0.0;  ///< of the estimate, in the axes of the grid
  double scale_ = 1.0;
  double confidence_ = 0.0;
  double fit_ = 0.0;
  bool has_fit_ = false;
};

}  // namespace cmn
