// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/belief_policy.hpp"

#include "coarse_map_nav/planning/exploration.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace cmn {
namespace {

constexpr std::size_t kMostHypotheses = 100;
constexpr double kLeastShare = 0.02;  ///< of the best hypothesis; less is left out
/// The way there is dearer than the cost-to-go counts (turns, nearness): progress must still pay.
constexpr double kGreed = 2.0;
/// What another way must be better by than the one that was chosen before.
constexpr double kResolve_m = 1.0;
/// Exploration: a place this far from all where the robot has been is new enough, and a metre of
/// way is worth so much newness.
constexpr double kNewEnough_m = 3.0;
constexpr double kHaste = 0.3;
/// Hypotheses farther than this from each other are distinct, and so many are told apart, by looks
/// that are new this far from where the robot has been.
constexpr double kApart_m = 1.0;
constexpr std::size_t kMostDistinct = 6;
constexpr double kNew_m = 1.5;
constexpr std::size_t kLongestTrail = 300;
/// Nearer than this to the goal there is no gap to get through.
constexpr double kNearGoal_m = 0.6;
constexpr int kMostGaps = 8;  ///< closed in one decision
/// A robot that has turned round once and goes on turning is in doubt between ways, each of which
/// looks better from the other's heading.
constexpr int kMostTurns = 5;

}  // namespace

BeliefPolicy::BeliefPolicy(const LatticeParams& lattice, const MapRepairParams& repair,
                           double step_m, bool information)
    : lattice_{lattice, step_m}, repair_{repair}, information_{information} {}

void BeliefPolicy::reset() {
  if (map_) {
    map_->forget_failures();
  }
  places_.forget_failures();
  places_.expect_anywhere();
  has_goal_ = false;
  last_ = ActionType::kStop;
  turns_ = 0;
  target_.reset();
  trail_.clear();
}

void BeliefPolicy::look(const Situation& situation) {
  if (situation.local_map == nullptr) {
    throw std::invalid_argument("the belief policy needs a local map");
  }
  if (!map_) {
    map_.emplace(situation.map, repair_);
  }
  lattice_.search(*situation.local_map, !situation.is_stuck);
  if (situation.is_stuck && !trail_.empty()) {
    // The step that remember() took for done was not.
    for (Cell& been : trail_) {
      been = been + Cell{1, 0};
    }
    places_.was_stuck(lattice_.step_m());
    target_.reset();
  }
  learn(situation);
  update_cost_to_go(situation);
  hypotheses_ = hypotheses(situation);
  best_ = best_state(situation, hypotheses_);
}

void BeliefPolicy::learn(const Situation& situation) {
  if (!repair_.enabled || situation.confidence < repair_.confidence) {
    return;
  }
  const double yaw_rad = situation.yaw_rad;
  const double cells_per_m = situation.scale / situation.map.resolution();
  places_.arrive(*map_, situation.position_cells, yaw_rad, cells_per_m);
  map_->fuse(*situation.local_map, lattice_.clearance(), lattice_.least_clearance_m(),
             situation.position_cells, yaw_rad, situation.scale);
  if (situation.is_stuck) {
    const double ahead = cells_per_m * (lattice_.step_m() + lattice_.least_clearance_m());
    map_->mark_failed(
        map_->part_of(situation.position_cells + turned(Point2{ahead, 0.0}, yaw_rad)));
  }
}

void BeliefPolicy::update_cost_to_go(const Situation& situation) {
  const std::vector<Cell> changed = map_->take_changed();
  if (has_goal_) {
    cost_to_go_.change(*map_, changed);
  } else {
    cost_to_go_ = RepairedCostToGo{*map_, map_->part_of(situation.goal_cells)};
    has_goal_ = true;
  }
}

std::vector<Hypothesis> BeliefPolicy::hypotheses(const Situation& situation) {
  const Belief& belief = situation.belief;
  std::vector<Estimate> candidates;
  const double least = kLeastShare * situation.estimate.probability;
  const auto consider = [&](Heading h, Cell c, double weight) {
    const double probability = belief.factor() * weight;
    if (probability > least) {
      candidates.push_back({h, c, probability});
    }
  };
  // Few: only they are looked at, in the order of a pass over all.
  if (situation.possible != nullptr) {
    for (const auto& [h, i] : *situation.possible) {
      const auto stride = static_cast<std::uint32_t>(belief.stride());
      consider(h, {static_cast<int>(i % stride) - 1, static_cast<int>(i / stride) - 1},
               belief.layer(h)[i]);
    }
    std::sort(candidates.begin(), candidates.end(), [](const Estimate& a, const Estimate& b) {
      return std::make_tuple(a.heading, a.cell.y, a.cell.x) <
             std::make_tuple(b.heading, b.cell.y, b.cell.x);
    });
    return weighed(situation, std::move(candidates));
  }
  for (const Heading h : kHeadings) {
    const std::vector<double>& layer = belief.layer(h);
    for (int y = 0; y < belief.height(); ++y) {
      const double* row = layer.data() + belief.padded_index({0, y});
      for (int x = 0; x < belief.width(); ++x) {
        consider(h, {x, y}, row[x]);
      }
    }
  }
  return weighed(situation, std::move(candidates));
}

std::vector<Hypothesis> BeliefPolicy::weighed(const Situation& situation,
                                              std::vector<Estimate> candidates) {
  if (candidates.size() > kMostHypotheses) {
    std::nth_element(
        candidates.begin(), candidates.begin() + kMostHypotheses, candidates.end(),
        [](const Estimate& a, const Estimate& b) { return a.probability > b.probability; });
    candidates.resize(kMostHypotheses);
  }
  // Within its cell every hypothesis lies as the estimate does in its own.
  const Point2 within = situation.position_cells - middle_of(situation.estimate.cell);
  std::vector<Hypothesis> found;
  double total = 0.0;
  for (const Estimate& c : candidates) {
    const int turns = index(c.heading) - index(situation.estimate.heading);
    found.push_back({{middle_of(c.cell) + turned(within, turns * kPi / 2.0),
                      situation.yaw_rad + turns * kPi / 2.0},
                     c.probability});
    total += c.probability;
  }
  for (Hypothesis& hypothesis : found) {
    hypothesis.weight /= total;
  }
  return found;
}

std::size_t BeliefPolicy::best_state(const Situation& situation,
                                     const std::vector<Hypothesis>& at) const {
  const double part_m = situation.map.resolution() / map_->cuts() / situation.scale;
  const double parts_per_m = 1.0 / part_m;
  std::vector<Point2> origins;
  std::vector<Point2> axes;  // of a metre ahead
  for (const Hypothesis& hypothesis : at) {
    origins.push_back(static_cast<double>(map_->cuts()) * hypothesis.pose.position_cells);
    axes.push_back(turned(Point2{parts_per_m, 0.0}, hypothesis.pose.yaw_rad));
  }
  const std::vector<double> savings = savings_m(situation, at);
  const double most_saved_m = *std::max_element(savings.begin(), savings.end());
  double least_m = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  const std::vector<LatticeState>& states = lattice_.states();
  // The four headings of one place share the expectation: only the cheapest can be the best.
  for (std::size_t k = 0; k < savings.size(); ++k) {
    const std::size_t i = lattice_.places()[k];
    if (states[i].cost_m - kResolve_m - most_saved_m >= least_m) {
      break;  // and so are all that follow
    }
    const Point2 p = lattice_.position_of(states[i]);
    double parts_to_go = 0.0;
    for (std::size_t j = 0; j < at.size(); ++j) {
      const Point2 there{origins[j].x + axes[j].x * p.x - axes[j].y * p.y,
                         origins[j].y + axes[j].y * p.x + axes[j].x * p.y};
      parts_to_go += at[j].weight * cost_to_go_.between(there);
    }
    double cost_m = states[i].cost_m + kGreed * (part_m * parts_to_go) - savings[k];
    if (is_near_target(states[i].offset)) {
      cost_m -= kResolve_m;
    }
    if (cost_m < least_m - 1e-6) {
      least_m = cost_m;
      best = i;
    }
  }
  return best;
}

std::vector<double> BeliefPolicy::savings_m(const Situation& situation,
                                            const std::vector<Hypothesis>& at) const {
  const std::vector<std::size_t>& places = lattice_.places();
  if (!information_ || situation.is_converged || situation.looks == nullptr) {
    return std::vector<double>(places.size(), 0.0);
  }
  const double cells_per_m = situation.scale / situation.map.resolution();
  const double parts_per_m = cells_per_m * map_->cuts();
  const std::vector<Hypothesis> few = distinct(at, kApart_m * cells_per_m, kMostDistinct);
  std::vector<std::vector<double>> costs_m;
  for (const Hypothesis& h : few) {
    costs_m.emplace_back();
    const Point2 origin = static_cast<double>(map_->cuts()) * h.pose.position_cells;
    for (const std::size_t i : places) {
      const LatticeState& state = lattice_.states()[i];
      const Point2 there =
          origin + turned(parts_per_m * lattice_.position_of(state), h.pose.yaw_rad);
      const double cost_m = state.cost_m + kGreed * cost_to_go_.between(there) / parts_per_m;
      // Whatever the drawing says of it, from there the robot can come back.
      costs_m.back().push_back(
          i == 0 ? cost_m
                 : std::min(cost_m, costs_m.back().front() + (1.0 + kGreed) * state.cost_m));
    }
  }
  std::vector<double> newness;
  for (const std::size_t i : places) {
    newness.push_back(newness_m(lattice_.states()[i].offset, kNew_m) / kNew_m);
  }
  return cmn::savings_m({lattice_, few, costs_m, newness, cells_per_m, situation.scale},
                        *situation.looks);
}

bool BeliefPolicy::close_gap(const Situation& situation) {
  if (situation.confidence < repair_.confidence) {
    return false;  // a gap of which place?
  }
  // Down the cost-to-go from here: the first part where no state of the lattice lies.
  const double parts_per_m = situation.scale * map_->cuts() / situation.map.resolution();
  const double yaw_rad = situation.yaw_rad;
  const Point2 origin = static_cast<double>(map_->cuts()) * situation.position_cells;
  const double near = std::max(0.75, 0.75 * lattice_.step_m() * parts_per_m);
  const auto is_in_reach = [&](Cell part) {
    return std::any_of(
        lattice_.states().begin(), lattice_.states().end(), [&](const LatticeState& s) {
          const Point2 p = origin + turned(parts_per_m * lattice_.position_of(s), yaw_rad);
          return std::max(std::abs(p.x - middle_of(part).x), std::abs(p.y - middle_of(part).y)) <=
                 near;
        });
  };
  std::optional<Cell> part{map_->part_of(situation.position_cells)};
  const int farthest = static_cast<int>(parts_per_m * 3.0);
  for (int i = 0; i < farthest && part; ++i) {
    if (!is_in_reach(*part)) {
      return map_->mark_failed(*part);
    }
    part = cost_to_go_.next(*part);
  }
  return false;
}

double BeliefPolicy::newness_m(Cell offset, double most_m) const {
  double new_m = most_m;
  int least_square = std::numeric_limits<int>::max();
  for (const Cell been : trail_) {
    const Cell off = offset - been;
    const int square = off.x * off.x + off.y * off.y;
    if (square <= least_square) {
      least_square = square;
      new_m = std::min(new_m, lattice_.step_m() * std::hypot(off.x, off.y));
    }
  }
  return new_m;
}

ActionType BeliefPolicy::explore(std::mt19937_64& rng) {
  const std::vector<LatticeState>& states = lattice_.states();
  std::size_t best = 0;
  double most_m = 0.0;
  // Of the states of one place the cheapest is the best; where the robot stands, that after a turn.
  std::vector<std::size_t> candidates = lattice_.places();
  candidates.front() = static_cast<std::size_t>(std::find_if(states.begin() + 1, states.end(),
                                                             [](const LatticeState& s) {
                                                               return s.offset == Cell{0, 0};
                                                             }) -
                                                states.begin());
  std::sort(candidates.begin(), candidates.end());
  for (const std::size_t i : candidates) {
    double worth_m = newness_m(states[i].offset, kNewEnough_m) - kHaste * states[i].cost_m;
    if (is_near_target(states[i].offset)) {
      worth_m += kResolve_m;
    }
    if (worth_m > most_m) {
      most_m = worth_m;
      best = i;
    }
  }
  best_ = best;
  if (best != 0) {
    return lattice_.first_action(best);
  }
  if (last_ == ActionType::kTurnLeft || last_ == ActionType::kTurnRight) {
    return last_;
  }
  return draw_turn(rng);
}

bool BeliefPolicy::may_go_forward() const {
  return std::any_of(lattice_.states().begin(), lattice_.states().end(), [](const LatticeState& s) {
    return s.parent == 0 && s.action == ActionType::kMoveForward;
  });
}

bool BeliefPolicy::is_near_target(Cell offset) const {
  return target_ && std::abs(offset.x - target_->x) <= 2 && std::abs(offset.y - target_->y) <= 2;
}

ActionType BeliefPolicy::choose(const Situation& situation, std::mt19937_64& rng) {
  const double off_m = situation.map.resolution() / situation.scale *
                       norm(situation.position_cells - situation.goal_cells);
  // Near the goal there is nothing to get through to; not sure of it yet, the robot looks around.
  const bool is_near_goal = off_m < kNearGoal_m;
  for (int i = 0; best_ == 0 && !is_near_goal && i < kMostGaps && close_gap(situation); ++i) {
    update_cost_to_go(situation);
    best_ = best_state(situation, hypotheses_);
  }
  ActionType action = lattice_.first_action(best_);
  if (action == ActionType::kStop) {
    action = explore(rng);
  }
  // To and fro on the spot teaches nothing; nor does turning round and round where two ways are as
  // good, each by a look the other way.
  const bool undoes_a_turn =
      quarter_turns(action) != 0 && quarter_turns(last_) == -quarter_turns(action);
  if (undoes_a_turn) {
    action = best_ != 0 && may_go_forward() ? ActionType::kMoveForward : last_;
  }
  turns_ = quarter_turns(action) != 0 ? turns_ + 1 : 0;
  if (turns_ > kMostTurns && may_go_forward()) {
    action = ActionType::kMoveForward;
    turns_ = 0;
  }
  last_ = action;
  remember(action);
  return action;
}

void BeliefPolicy::remember(ActionType action) {
  target_.reset();
  if (best_ != 0) {
    target_ = lattice_.states()[best_].offset;
  }
  places_.moved(action, lattice_.step_m());
  // As all will lie when the action is done.
  trail_.push_back({0, 0});
  if (trail_.size() > kLongestTrail) {
    trail_.pop_front();
  }
  const auto moved = [action](Cell c) {
    return action == ActionType::kMoveForward ? c - Cell{1, 0} : turned(c, -quarter_turns(action));
  };
  std::transform(trail_.begin(), trail_.end(), trail_.begin(), moved);
  if (target_) {
    target_ = moved(*target_);
  }
}

std::optional<double> BeliefPolicy::distance_to_go_m(const Situation& situation) {
  return cost_to_go_.between(static_cast<double>(map_->cuts()) * situation.position_cells) *
         situation.map.resolution() / map_->cuts() / situation.scale;
}

}  // namespace cmn
