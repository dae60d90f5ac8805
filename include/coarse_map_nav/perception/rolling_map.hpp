// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the robot has seen around itself lately: no need to turn round for every look.
#pragma once

#include "coarse_map_nav/data/geometry.hpp"
#include "coarse_map_nav/data/grid.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/perception/accumulator.hpp"
#include "coarse_map_nav/perception/look_alignment.hpp"

#include <cstdint>
#include <optional>

#include <opencv2/core.hpp>

namespace cmn {

struct RollingMapParams {
  double most_looks = 0.5;
  double memory_m = 6.0;
  double carried_share = 0.2;
  AlignmentParams align;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("most_looks", self.most_looks, Between{0.1, 100.0},
          "[looks] rolling map: what was seen before never counts more than this");
    visit("memory_m", self.memory_m, Between{0.1, 1000.0},
          "[m] rolling map: the way after which what was seen counts 1/e");
    visit(
        "carried_share", self.carried_share, Between{0.0, 1.0},
        "[-] rolling map: what was seen is forgotten when so much of what stands in a look is amid "
        "what was seen to be free, and the other way round: the robot was carried; 1: never");
    visit.group("align", self.align);
  }
};

/// The rolling local map of CMP (Gupta et al. 2017, eq. 1 to 3), with analytic occupancy: estimate
/// f and confidence c are carried along by egomotion, and a look (f', c') is folded in by f <- (f c
/// + f' c') / (c + c'), c <- c + c'.
///
/// What is only presumed (kPresumed) changes nothing that is known. Three differences (ours): the
/// grid keeps its place in a frame of its own and scrolls with the robot, since warping it anew at
/// each step blurs walls away; confidence is limited and fades with the way driven, since people
/// move; and each look is aligned with what was seen before (align_look), since odometry drifts: of
/// a robot that turns often, it would draw arcs for walls.
class RollingMap : public Accumulator {
 public:
  explicit RollingMap(const RollingMapParams& params) : params_{params} {}

  LocalOccupancy fuse(LocalOccupancy look, const Pose2& T_odom_robot) override;
  void forget() override;
  std::optional<HeadingDrift> heading_drift() const override;

 private:
  /// Where a cell of the map's frame is kept: the window is wrapped round.
  Cell place_of(Cell c) const;
  /// What a look is aligned with: what was known a little way ago, and what has been seen since
  /// where nothing was. Aligned with the very last looks, which are what most of the map is made
  /// of, a robot that stands and turns would creep round with them by parts of a cell.
  enum class Anchor : std::uint8_t { kNone, kFree, kStanding };
  /// Of the window: 1 where something stands beside free ground, 0 elsewhere.
  cv::Mat1b anchored_surface() const;
  /// Takes what is known now for the anchor, after some way everywhere, else where it has none.
  void anchor(double driven_m);
  void scroll_to(Cell middle);
  /// What was seen counts less from now on.
  void age(double driven_m);
  void fold_in(const LocalOccupancy& look, const Pose2& T_map_robot);
  /// `look`, and what else is known where it lies.
  LocalOccupancy all_known(LocalOccupancy look, const Pose2& T_map_robot) const;

  RollingMapParams params_;
  Grid<float> occupancy_;
  Grid<float> confidence_;  ///< 0: unknown
  Grid<Anchor> anchor_;
  double since_anchor_m_ = 0.0;
  double resolution_ = 0.0;
  Pose2 T_map_odom_;  ///< of the looks as they were aligned; kept when all else is forgotten
  std::optional<double> first_stamp_s_;
  Cell middle_;  ///< cell of the map's frame that the window is about
  Pose2 T_odom_last_;
  LocalOccupancy last_;  ///< what was known then
};

}  // namespace cmn
