// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How well what the robot sees fits each cell and heading.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/localization/neighbourhood.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace cmn {

struct MeasurementModelParams {
  std::string type = "overlap";
  int window_reach = 1;
  double window_m = 1.28;
  bool unseen_is_occupied = true;
  double exponent = 2.0;
  int window_cells() const { return 2 * window_reach + 1; }
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("type", self.type, OneOf{{"overlap"}}, "overlap: CMN eq. 2");
    visit(
        "window_reach", self.window_reach, Between{0, 15},
        "[cells] the compared window of the drawing has n = 2 reach + 1 cells a side (CMN: n = 3)");
    visit("window_m", self.window_m, Between{0.1, 50.0},
          "[m] side of the square of the observation that is compared with it (CMN: 1.28)");
    visit("unseen_is_occupied", self.unseen_is_occupied, Anything{},
          "Robb: everything beyond a hit is occupied; false: unseen cells say nothing");
    visit("exponent", self.exponent, Between{0.1, 100.0},
          "[-] the likelihood is raised to this power (2 in CMN's released parameters)");
  }
};

/// Which of the four headings.
using HeadingSet = std::array<bool, 4>;
constexpr HeadingSet kAllHeadings{true, true, true, true};

/// P(seen | heading, cell) up to a factor: for each heading one value a kind of cells.
using Likelihood = std::array<std::vector<double>, 4>;

class MeasurementModel {
 public:
  virtual ~MeasurementModel() = default;
  virtual const WindowKinds& kinds() const = 0;
  /// `residual_yaw_rad`: how far the robot is turned from the nearest odometry axis; the
  /// observation is turned back by it, so that headings are those of the axes.
  /// `weight` in [0, 1]: how much of this look is news; the likelihood is raised to it.
  /// Only `headings` are looked at: the others' values mean nothing.
  /// The result is good until the next call.
  virtual const Likelihood& measure(const LocalOccupancy& seen, double residual_yaw_rad,
                                    double weight, const HeadingSet& headings) = 0;
};

/// The observation averaged down to n^2 values in [0, 1], x fastest, in the axes of
/// the nearest odometry axis. Cells about which nothing is known count as 0.5, unseen ones as
/// 1 or not at all. Exact block averages when `residual_yaw_rad` is 0, else by cell centres.
std::vector<double> reduce(const LocalOccupancy& seen, const MeasurementModelParams& params,
                           double residual_yaw_rad);

/// CMN eq. 2: L(k, c) = (1 - (1/n^2) sum |m_hat_k - m(c)|)^exponent, with m(c) the n x n window of
/// the map about c and m_hat_k the observation turned by heading k. Cells outside are occupied.
///
/// The sum over a piece of the window depends on nine bits of the map: a table of it, built anew
/// for each observation by one addition an entry, costs one look-up a piece and kind of window.
class OverlapModel : public MeasurementModel {
 public:
  OverlapModel(const CoarseMap& map, const MeasurementModelParams& params);
  const WindowKinds& kinds() const override { return kinds_; }
  const Likelihood& measure(const LocalOccupancy& seen, double residual_yaw_rad, double weight,
                            const HeadingSet& headings) override;

 private:
  void fill(const std::vector<double>& window, Heading heading, double exponent);

  MeasurementModelParams params_;
  WindowKinds kinds_;
  Likelihood likelihood_;
  /// By piece: the share of each of its codes in the sum.
  std::vector<std::array<double, kNeighbourhoods>> sums_;
};

std::unique_ptr<MeasurementModel> make_measurement_model(const MeasurementModelParams& params,
                                                         const CoarseMap& map);

}  // namespace cmn
