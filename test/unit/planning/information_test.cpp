// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/planning/information.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

namespace cmn {
namespace {

/// Looks tell all pairs apart where the first pose is east of this column.
class LooksOfTheEast : public ExpectedLooks {
 public:
  explicit LooksOfTheEast(double from) : from_{from} {}
  std::vector<double> apart(const std::vector<GridPose>& poses, double /*scale*/) const override {
    return std::vector<double>(poses.size() * (poses.size() - 1) / 2,
                               poses.front().position_cells.x > from_ ? 2.0 : 0.0);
  }

 private:
  double from_;
};

/// A robot that faces east in the middle of a floor of 8 m, by 0.4 m a cell at (20, 20) or, so far
/// as there are more hypotheses, 20 cells farther east each.
class OnAFloor : public ::testing::Test {
 protected:
  OnAFloor() {
    LocalOccupancy floor{80, 0.1};
    std::fill(floor.occupancy.begin(), floor.occupancy.end(), 0.0F);
    std::fill(floor.confidence.begin(), floor.confidence.end(), 1.0F);
    lattice_.search(floor);
    newness_.assign(lattice_.places().size(), 1.0);
  }
  /// `wishes_m`: of each hypothesis, how far ahead its goal is.
  std::vector<double> savings_m(const std::vector<double>& wishes_m, double told_from) {
    std::vector<Hypothesis> hypotheses;
    std::vector<std::vector<double>> costs_m;
    for (const double wish_m : wishes_m) {
      hypotheses.push_back({{{20.0 + 20.0 * static_cast<double>(hypotheses.size()), 20.0}, 0.0},
                            1.0 / static_cast<double>(wishes_m.size())});
      costs_m.emplace_back();
      for (const std::size_t i : lattice_.places()) {
        const LatticeState& state = lattice_.states()[i];
        const Point2 off = lattice_.position_of(state) - Point2{wish_m, 0.0};
        costs_m.back().push_back(state.cost_m + 2.0 * norm(off));
      }
    }
    return cmn::savings_m({lattice_, hypotheses, costs_m, newness_, 2.5, 1.0},
                          LooksOfTheEast{told_from});
  }

  LocalLattice lattice_{LatticeParams{}, 0.2};
  std::vector<double> newness_;
};

TEST_F(OnAFloor, OneHypothesisHasNothingToLearn) {
  EXPECT_EQ(savings_m({2.0}, 0.0), std::vector<double>(newness_.size(), 0.0));
}

TEST_F(OnAFloor, ThoseThatWantTheSameNeedNotBeToldApart) {
  for (const double saved_m : savings_m({2.0, 2.0, 2.0}, 0.0)) {
    EXPECT_NEAR(saved_m, 0.0, 1e-9);
  }
}

TEST_F(OnAFloor, SavesWhereLooksDifferMoreThanHere) {
  const std::vector<double> saved_m = savings_m({2.0, -2.0}, 22.0);
  double most_m = 0.0;
  for (std::size_t k = 0; k < saved_m.size(); ++k) {
    const Point2 p = lattice_.position_of(lattice_.states()[lattice_.places()[k]]);
    if (20.0 + 2.5 * p.x > 22.0) {
      EXPECT_GT(saved_m[k], 0.0) << p.x << ' ' << p.y;
    }
    most_m = std::max(most_m, saved_m[k]);
  }
  EXPECT_EQ(saved_m.front(), 0.0);
  // Each loses, as often as it takes itself for the other, the way of 4 m, twice by its to-go.
  EXPECT_GT(most_m, 1.0);
  EXPECT_LT(most_m, 6.0);
  // Where looks differ here as well, they have told all they can.
  for (const double nothing_m : savings_m({2.0, -2.0}, 0.0)) {
    EXPECT_EQ(nothing_m, 0.0);
  }
}

TEST_F(OnAFloor, WhatWasSeenTellsNothingAgain) {
  newness_.assign(newness_.size(), 0.0);
  EXPECT_EQ(savings_m({2.0, -2.0}, 22.0), newness_);
}

TEST(Distinct, PutsTogetherWhatIsNearAndFacesTheSameWay) {
  const std::vector<Hypothesis> found = distinct({{{{5.0, 5.0}, 0.0}, 0.2},
                                                  {{{6.0, 5.0}, 0.0}, 0.3},
                                                  {{{6.0, 5.0}, kPi}, 0.1},
                                                  {{{30.0, 5.0}, 0.0}, 0.25}},
                                                 2.5, 9);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_DOUBLE_EQ(found[0].weight, 0.5);
  EXPECT_DOUBLE_EQ(found[0].pose.position_cells.x, 6.0);
  EXPECT_DOUBLE_EQ(found[1].weight, 0.25);
  EXPECT_DOUBLE_EQ(found[2].weight, 0.1);
}

TEST(Distinct, KeepsTheLikeliest) {
  const std::vector<Hypothesis> found = distinct(
      {{{{0.0, 0.0}, 0.0}, 0.2}, {{{9.0, 0.0}, 0.0}, 0.5}, {{{18.0, 0.0}, 0.0}, 0.3}}, 2.5, 2);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_DOUBLE_EQ(found[0].weight, 0.5);
  EXPECT_DOUBLE_EQ(found[1].weight, 0.3);
}

}  // namespace
}  // namespace cmn
