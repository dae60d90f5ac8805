// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A planning copy of the drawing that learns what is blocked and what is open.
#pragma once

#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"
#include "coarse_map_nav/data/param_tree.hpp"
#include "coarse_map_nav/planning/local_lattice.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cmn {

struct MapRepairParams {
  bool enabled = true;
  double cell_m = 0.2;
  double confidence = 0.5;
  double open_share = 0.15;
  double known_share = 0.6;
  int drawn_wall_cost = 25;
  int seen_wall_cost = 100;
  template <class Self, class Visitor>
  static void visit_params(Self& self, Visitor&& visit) {
    visit("enabled", self.enabled, Anything{}, "plan on a copy of the drawing that is repaired");
    visit("cell_m", self.cell_m, Between{0.02, 2.0},
          "[m] map repair: cells of the drawing are cut until they are no larger");
    visit("confidence", self.confidence, Between{0.0, 1.0},
          "[-] map repair: nothing is learned while the confidence is below");
    visit("open_share", self.open_share, Between{0.0, 1.0},
          "[-] map repair: so much of a cell must be drivable to call it open");
    visit("known_share", self.known_share, Between{0.0, 1.0},
          "[-] map repair: so much of a cell must be seen to call it blocked");
    visit("drawn_wall_cost", self.drawn_wall_cost, Between{1, 1000},
          "[-] a step through what is occupied on the drawing costs as many free ones: the drawing "
          "may lack a door there");
    visit("seen_wall_cost", self.seen_wall_cost, Between{1, 1000},
          "[-] and one through what was seen to be blocked");
  }
};

/// Traversability of the ground, in cells no larger than `cell_m`: where the *middle* of the robot
/// can be (ours). The prior is the drawing. Localization never sees it: it keeps the original.
class RepairedMap {
  /// Looks for (> 0) and against (< 0) a part's being open, at most kMostLooks either way. What is
  /// drawn counts as one look. One byte: there may be millions.
  struct Part {
    std::int8_t looks : 4;
    bool is_open : 1;
    bool was_seen : 1;
    bool has_failed : 1;
  };
  static_assert(sizeof(Part) == 1);

 public:
  /// All that is not as drawn.
  class Learned {
   public:
    void forget_failures();

   private:
    friend class RepairedMap;
    std::vector<std::pair<std::size_t, Part>> parts_;  ///< by their index
  };

  RepairedMap(const CoarseMap& drawing, const MapRepairParams& params);

  /// Parts that a cell of the drawing is cut into along each side.
  int cuts() const { return cuts_; }
  /// The part that holds a point given in cells of the drawing.
  Cell part_of(Point2 position_cells) const;
  int width() const { return parts_.width(); }
  int height() const { return parts_.height(); }
  bool contains(Cell part) const { return parts_.contains(part); }
  /// What a step into this part costs, in steps into a free one.
  int cost(Cell part) const;
  /// No step ever costs more.
  int dearest() const;
  bool is_open(Cell part) const { return parts_(part).is_open && !parts_(part).has_failed; }

  /// Learns from what the robot sees around itself, standing at `position_cells` of the drawing
  /// with its x axis along `yaw_rad` of the grid; a metre on the ground is `scale` metres drawn.
  /// True when any cost changed.
  bool fuse(const LocalOccupancy& local, const ClearanceMap& clearance, double least_clearance_m,
            Point2 position_cells, double yaw_rad, double scale = 1.0);
  /// The robot could not get through here, whatever it sees. Kept until forget_failures().
  bool mark_failed(Cell part);
  void forget_failures();
  /// As drawn again, but for what was learned `instead`; returns what was learned till now.
  Learned exchange(const Learned& instead);
  /// The parts whose cost may have changed since this was last asked, but for the two that forget.
  std::vector<Cell> take_changed() { return std::exchange(changed_, {}); }
  /// As drawn again.
  void forget();

  /// For people: what is taken to be drivable.
  CoarseMap as_map() const;

 private:
  Part drawn(std::size_t index) const;

  static constexpr int kMostLooks = 4;

  CoarseMap drawing_;
  MapRepairParams params_;
  int cuts_ = 1;
  Grid<Part> parts_;
  struct Tally {
    int known = 0;
    int drivable = 0;
  };
  std::vector<Cell> changed_;
  std::vector<Tally> tallies_;  ///< scratch, of the parts in view
};

}  // namespace cmn
