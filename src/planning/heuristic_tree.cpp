// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/heuristic_tree.hpp"

#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/planning/cost_to_go.hpp"
#include "coarse_map_nav/planning/grid_planner.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace cmn {
namespace {

constexpr std::array<ActionType, 3> kActions{ActionType::kMoveForward, ActionType::kTurnLeft,
                                             ActionType::kTurnRight};
/// Below this two cosines are the same; displacements of so few steps differ by far more.
constexpr double kEqual = 1e-9;

int squared_length(Cell c) { return c.x * c.x + c.y * c.y; }

double cosine(Cell a, Cell b) {
  const double lengths = std::sqrt(static_cast<double>(squared_length(a) * squared_length(b)));
  return lengths > 0.0 ? (a.x * b.x + a.y * b.y) / lengths : 0.0;
}

/// The first step from the estimate towards the goal; (0, 0) where there is none.
Cell heuristic_step(const Situation& s, bool uses_diagonals) {
  if (!s.cost_to_go.is_reachable(s.estimate.cell) || s.estimate.cell == s.cost_to_go.goal()) {
    return {0, 0};
  }
  if (uses_diagonals) {
    return shortest_path(s.map, s.estimate.cell, s.cost_to_go.goal(), Connectivity::kEight,
                         unit_step(s.estimate.heading))
               .cells[1] -
           s.estimate.cell;
  }
  return unit_step(*s.cost_to_go.next_heading(s.estimate.cell, s.estimate.heading));
}

}  // namespace

ActionTree::ActionTree(int depth) {
  assert(depth >= 2);
  struct Node {
    Leaf leaf;
    Heading heading = Heading::kEast;
  };
  std::vector<Node> layer{Node{}};
  for (int k = 0; k < depth; ++k) {
    std::vector<Node> next;
    for (const Node& node : layer) {
      for (const ActionType action : kActions) {
        Node child = node;
        if (k == 0) {
          child.leaf.first = action;
        }
        if (action == ActionType::kMoveForward) {
          child.leaf.displacement = child.leaf.displacement + unit_step(child.heading);
        } else {
          child.heading = turned(child.heading, quarter_turns(action));
          ++child.leaf.turns;
        }
        next.push_back(child);
      }
    }
    layer.swap(next);
  }
  for (const Node& node : layer) {
    leaves_.push_back(node.leaf);
  }
}

ActionType ActionTree::choose(Cell h, bool may_go_forward, std::mt19937_64& rng) const {
  double best_cosine = -2.0;
  const Leaf* best = nullptr;
  std::vector<ActionType> firsts;  // of the leaves as good as the best one
  for (const Leaf& leaf : leaves_) {
    if (leaf.first == ActionType::kMoveForward && !may_go_forward) {
      continue;
    }
    const double c = cosine(leaf.displacement, h);
    const bool is_tie = std::abs(c - best_cosine) < kEqual;
    const auto rank = std::make_tuple(leaf.turns, -squared_length(leaf.displacement));
    const auto best_rank =
        best ? std::make_tuple(best->turns, -squared_length(best->displacement)) : rank;
    if (is_tie ? rank < best_rank : c > best_cosine) {
      best_cosine = c;
      best = &leaf;
      firsts = {leaf.first};
    } else if (is_tie && rank == best_rank && leaf.first != firsts.back()) {
      firsts.push_back(leaf.first);  // leaves are in the order of their first actions
    }
  }
  return firsts.size() == 1 ? firsts.front() : firsts[draw_index(rng, firsts.size())];
}

ActionType HeuristicTree::choose(const Situation& situation, std::mt19937_64& rng) {
  const Cell h =
      turned(heuristic_step(situation, uses_diagonals_), -index(situation.estimate.heading));
  if (h == Cell{0, 0}) {
    return exploration_.wander(situation.is_blocked_ahead, p_turn_, rng);
  }
  const ActionType wish = tree_.choose(h, true, rng);
  const ActionType turn = wish == ActionType::kMoveForward ? tree_.choose(h, false, rng) : wish;
  return exploration_.follow(wish, situation.is_blocked_ahead, turn);
}

}  // namespace cmn
