// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where to next: the seam between the planners of the papers and ours.
#pragma once

#include "coarse_map_nav/data/action.hpp"
#include "coarse_map_nav/data/belief.hpp"
#include "coarse_map_nav/data/coarse_map.hpp"
#include "coarse_map_nav/data/expected_looks.hpp"
#include "coarse_map_nav/data/local_occupancy.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace cmn {

class CostToGo;
class RepairedMap;

/// All that a policy may look at.
struct Situation {
  const CoarseMap& map;
  const Belief& belief;
  const CostToGo& cost_to_go;  ///< towards the goal, of the whole map
  Estimate estimate;
  Point2 position_cells{};  ///< finer than its cell
  double yaw_rad = 0.0;     ///< finer than its heading
  Point2 goal_cells{};      ///< finer than the goal's cell
  double confidence = 0.0;  ///< probability within 1 m of the estimate, at its heading
  bool is_converged = false;
  bool is_blocked_ahead = false;  ///< the obstacle guard refuses to move forward, or is_stuck
  bool is_stuck = false;          ///< the last action was a step forward, and ended blocked
  double scale = 1.0;             ///< nominal map metres a metre
  double axes_yaw_rad = 0.0;      ///< see Localization
  const LocalOccupancy* local_map = nullptr;  ///< what is seen farther around, where it is known
  const std::vector<std::pair<Heading, std::uint32_t>>* possible = nullptr;  ///< see Localization
  const ExpectedLooks* looks = nullptr;                                      ///< likewise
};

/// Chooses one action at a time. May remember what it did; `rng` is its only source of chance.
class Policy {
 public:
  virtual ~Policy() = default;
  /// Comes before the other questions of a decision.
  virtual void look(const Situation& /*situation*/) {}
  virtual ActionType choose(const Situation& situation, std::mt19937_64& rng) = 0;
  /// Forgets the past: a new goal, a new place.
  virtual void reset() {}
  /// The cost-to-go of the estimate by a map of the policy's own [m]; nothing: as on the drawing.
  virtual std::optional<double> distance_to_go_m(const Situation& /*situation*/) {
    return std::nullopt;
  }
  /// True when nothing in reach is nearer to the goal than where the robot stands.
  virtual bool is_as_near_as_can_be() const { return true; }
  /// What the policy has learned about the drawing; null: nothing.
  virtual const RepairedMap* repaired_map() const { return nullptr; }
};

struct PlanningParams;
/// "random", "heuristic_tree" (CMN), "path" (Robb), "lattice" or "belief" (ours), by
/// `params.policy`.
std::unique_ptr<Policy> make_policy(const PlanningParams& params);

}  // namespace cmn
