// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/belief_filter.hpp"

#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "random_case.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

LocalizationParams scaled() {
  LocalizationParams params;
  params.motion.type = "scaled";
  return params;
}

/// A motion that ends on an axis or off it, as long as some cells.
Displacement random_displacement(std::mt19937_64& rng) {
  return {3.0 * draw_uniform(rng) - 1.0, 2.0 * draw_uniform(rng) - 1.0,
          static_cast<int>(draw_index(rng, 4)) - 1};
}

TEST(BeliefFilterProperty, AnyEpisodeKeepsUnitMassOnFreeCells) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    LocalizationParams params;
    params.motion.type = seed % 2 == 0 ? "noisy" : "scaled";
    params.measurement.window_reach = 1 + static_cast<int>(seed % 3);
    BeliefFilter filter{random_map(rng, 3 + static_cast<int>(seed % 9), 7), params};
    for (int i = 0; i < 20; ++i) {
      filter.predict(random_displacement(rng));
      ASSERT_NEAR(total(filter.belief()), 1.0, 1e-12);
      filter.correct(random_observation(rng, 6), 1.5 * draw_uniform(rng) - 0.75);
      ASSERT_NEAR(total(filter.belief()), 1.0, 1e-12);
      for (int y = 0; y < filter.map().height(); ++y) {
        for (int x = 0; x < filter.map().width(); ++x) {
          for (const Heading h : kHeadings) {
            ASSERT_TRUE(filter.map().is_free({x, y}) || filter.belief()(h, {x, y}) == 0.0);
          }
        }
      }
    }
  }
}

TEST(BeliefFilterProperty, ADayOfObservationsNeitherUnderflowsNorOverflows) {
  std::mt19937_64 rng{1};
  BeliefFilter filter{random_map(rng, 8, 7), LocalizationParams{}};
  for (int i = 0; i < 5000; ++i) {
    filter.predict({0.4, 0.0, i % 2});
    filter.correct(random_observation(rng, 6));
  }
  EXPECT_NEAR(total(filter.belief()), 1.0, 1e-12);
  EXPECT_TRUE(filter.confidence() > 0.0 && filter.confidence() <= 1.0 + 1e-12);
  EXPECT_TRUE(std::isfinite(entropy(filter.belief())));
}

// The same filter, written down once more as a hidden Markov model over an explicit state list.
class ExhaustiveFilter {
 public:
  explicit ExhaustiveFilter(const CoarseMap& map) : map_{map} {
    for (int k = 0; k < 4; ++k) {
      for (int y = 0; y < map.height(); ++y) {
        for (int x = 0; x < map.width(); ++x) {
          if (map.is_free({x, y})) {
            belief_[{k, x, y}] = 1.0;
          }
        }
      }
    }
    normalise();
  }

  /// CMN eq. 1 for one forward action with a known p.
  void forward(double p) {
    std::map<State, double> moved;
    for (const auto& [state, b] : belief_) {
      const auto [k, x, y] = state;
      const Cell next = Cell{x, y} + unit_step(kHeadings[static_cast<std::size_t>(k)]);
      if (map_.is_free(next)) {
        moved[{k, next.x, next.y}] += p * b;
        moved[state] += (1.0 - p) * b;
      } else {
        moved[state] += b;
      }
    }
    belief_ = moved;
  }

  void turn(int quarter_turns) {
    std::map<State, double> turned_belief;
    for (const auto& [state, b] : belief_) {
      const auto [k, x, y] = state;
      turned_belief[{((k + quarter_turns) % 4 + 4) % 4, x, y}] = b;
    }
    belief_ = turned_belief;
  }

  /// CMN eq. 2 and 3: `seen(forward, left)` is the observation in cells about the robot.
  void correct(const LocalOccupancy& seen, double exponent) {
    const int n = seen.size;
    for (auto& [state, b] : belief_) {
      const auto [k, x, y] = state;
      double difference = 0.0;
      for (int iy = 0; iy < n; ++iy) {
        for (int ix = 0; ix < n; ++ix) {
          double yaw_rad = k * kPi / 2.0;
          const Point2 offset = turned(Point2{ix - n / 2.0 + 0.5, iy - n / 2.0 + 0.5}, yaw_rad);
          const Cell c{x + static_cast<int>(std::lround(offset.x)),
                       y + static_cast<int>(std::lround(offset.y))};
          const double m = map_.is_occupied(c) ? 1.0 : 0.0;
          difference += std::abs(static_cast<double>(seen.occupancy[seen.index_of(ix, iy)]) - m);
        }
      }
      b *= std::pow(1.0 - difference / (n * n), exponent);
    }
    normalise();
  }

  double operator()(Heading h, Cell c) const {
    const auto found = belief_.find({index(h), c.x, c.y});
    return found == belief_.end() ? 0.0 : found->second;
  }

 private:
  using State = std::tuple<int, int, int>;
  void normalise() {
    double sum = 0.0;
    for (const auto& entry : belief_) {
      sum += entry.second;
    }
    for (auto& entry : belief_) {
      entry.second /= sum;
    }
  }
  CoarseMap map_;
  std::map<State, double> belief_;
};

TEST(BeliefFilterOracle, EqualsTheExhaustiveFilterOnTinyMaps) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const CoarseMap map =
        random_map(rng, 2 + static_cast<int>(draw_index(rng, 5)), 2 + static_cast<int>(seed % 5));
    LocalizationParams params = scaled();
    params.measurement.window_reach = static_cast<int>(seed % 3);
    params.measurement.exponent = seed % 2 == 0 ? 2.0 : 1.0;
    const int n = params.measurement.window_cells();
    BeliefFilter filter{map, params};
    ExhaustiveFilter oracle{map};
    for (int i = 0; i < 30; ++i) {
      const std::size_t what = draw_index(rng, 3);
      if (what == 0) {
        const double p = draw_uniform(rng);
        filter.predict({p * map.resolution(), 0.0, 0});
        oracle.forward(p);
      } else {
        const int turn = what == 1 ? 1 : -1;
        filter.predict({0.0, 0.0, turn});
        oracle.turn(turn);
      }
      const LocalOccupancy seen = random_observation(rng, n);
      ASSERT_EQ(filter.correct(seen), Correction::kApplied);
      oracle.correct(seen, params.measurement.exponent);
      for (const Heading h : kHeadings) {
        for (int y = 0; y < map.height(); ++y) {
          for (int x = 0; x < map.width(); ++x) {
            ASSERT_NEAR(filter.belief()(h, {x, y}), oracle(h, {x, y}), 1e-9);
          }
        }
      }
    }
  }
}

TEST(BeliefFilterProperty, OneNoisyActionIsAMixtureOfStayingAndMoving) {
  // The p that was drawn can be read off one cell; it must then explain all the others.
  std::mt19937_64 rng{7};
  const CoarseMap map = random_map(rng, 9, 9);
  std::vector<double> drawn;
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    LocalizationParams params;
    params.seed = seed;
    BeliefFilter filter{map, params};
    filter.correct(random_observation(rng, 3));
    const Belief before = filter.belief();
    filter.predict({kCmnStep_m, 0.0, 0});
    double p = -1.0;
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 9; ++x) {
        const Cell c{x, y};
        const Cell behind{x - 1, y};
        const double came = map.is_free(behind) ? before(Heading::kEast, behind) : 0.0;
        const bool may_leave = map.is_free({x + 1, y});
        const double own = before(Heading::kEast, c);
        if (map.is_free(c) && p < 0.0 && std::abs(came - (may_leave ? own : 0.0)) > 1e-6) {
          p = (filter.belief()(Heading::kEast, c) - own) / (came - (may_leave ? own : 0.0));
        }
      }
    }
    ASSERT_GE(p, 0.0);
    ASSERT_LE(p, 1.0);
    drawn.push_back(p);
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 9; ++x) {
        const Cell c{x, y};
        if (map.is_free(c)) {
          const double came =
              map.is_free({x - 1, y}) ? before(Heading::kEast, Cell{x - 1, y}) : 0.0;
          const double stays = map.is_free({x + 1, y}) ? 1.0 - p : 1.0;
          EXPECT_NEAR(filter.belief()(Heading::kEast, c),
                      p * came + stays * before(Heading::kEast, c), 1e-9);
        }
      }
    }
  }
  double mean = 0.0;
  for (const double p : drawn) {
    mean += p / static_cast<double>(drawn.size());
  }
  EXPECT_NEAR(mean, 0.5, 0.08);  // N = 200 uniform draws: standard error 0.02; measured 0.50
}

TEST(BeliefFilterProperty, TurningTheMapTurnsTheBelief) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const CoarseMap map = random_map(rng, 5, 8);
    BeliefFilter filter{map, scaled()};
    BeliefFilter turned_filter{turned_left(map), scaled()};
    for (int i = 0; i < 10; ++i) {
      const Displacement driven = random_displacement(rng);
      const LocalOccupancy seen = random_observation(rng, 12);
      const double residual = draw_uniform(rng) - 0.5;
      filter.predict(driven);
      filter.correct(seen, residual);
      turned_filter.predict(driven);
      turned_filter.correct(seen, residual);
      for (const Heading h : kHeadings) {
        for (int y = 0; y < map.height(); ++y) {
          for (int x = 0; x < map.width(); ++x) {
            ASSERT_NEAR(filter.belief()(h, {x, y}),
                        turned_filter.belief()(turned(h, 1), {map.height() - 1 - y, x}), 1e-12);
          }
        }
      }
    }
  }
}

TEST(BeliefFilterProperty, UpdateIsPredictThenCorrect) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const CoarseMap map = random_map(rng, 8, 6);
    BeliefFilter at_once{map, scaled()};
    BeliefFilter in_halves{map, scaled()};
    Pose2 T_odom_robot{0.3, -0.2, 0.1};
    for (int i = 0; i < 15; ++i) {
      const LocalOccupancy seen = random_observation(rng, 9);
      const Pose2 T_before = T_odom_robot;
      if (i > 0) {
        const Pose2 T_step{draw_uniform(rng), 0.2 * draw_uniform(rng), 4.0 * draw_uniform(rng)};
        T_odom_robot = T_odom_robot * T_step;
        in_halves.predict(displacement(T_before, T_odom_robot));
      }
      at_once.update(seen, T_odom_robot);
      in_halves.correct(seen, residual_yaw(T_odom_robot));
      for (const Heading h : kHeadings) {
        for (int y = 0; y < map.height(); ++y) {
          for (int x = 0; x < map.width(); ++x) {
            ASSERT_NEAR(at_once.belief()(h, {x, y}), in_halves.belief()(h, {x, y}), 1e-12);
          }
        }
      }
    }
  }
}

TEST(BeliefFilterProperty, WindowsOfAnySizeEqualTheDirectSum) {
  for (std::uint32_t seed = 0; seed < 70; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const CoarseMap map = random_map(rng, 9, 6);
    MeasurementModelParams params;
    params.window_reach = std::vector<int>{0, 1, 2, 4, 5, 9, 15}[seed % 7];
    params.exponent = std::vector<double>{1.0, 2.0, 5.0, 0.7}[seed % 4];
    const int n = params.window_cells();
    const LocalOccupancy seen = random_observation(rng, n);
    OverlapModel model{map, params};
    const Likelihood& likelihood = model.measure(seen, 0.0, 1.0, kAllHeadings);
    const Belief layout{map.width(), map.height()};
    for (const Heading h : kHeadings) {
      for (int y = 0; y < map.height(); ++y) {
        for (int x = 0; x < map.width(); ++x) {
          if (map.is_occupied({x, y})) {
            continue;
          }
          double sum = 0.0;
          for (int w = 0; w < n * n; ++w) {
            const Cell offset = turned(Cell{w % n - n / 2, w / n - n / 2}, index(h));
            const double m = map.is_occupied(Cell{x, y} + offset) ? 1.0 : 0.0;
            sum += std::abs(static_cast<double>(seen.occupancy[static_cast<std::size_t>(w)]) - m);
          }
          const auto k = static_cast<std::size_t>(index(h));
          ASSERT_NEAR(likelihood[k][model.kinds().of_cell[layout.padded_index({x, y})]],
                      std::pow(1.0 - sum / (n * n), params.exponent), 1e-12);
        }
      }
    }
  }
}

TEST(BeliefFilterProperty, FourQuarterTurnsAreNone) {
  std::mt19937_64 rng{3};
  BeliefFilter filter{random_map(rng, 6, 6), LocalizationParams{}};
  filter.correct(random_observation(rng, 3));
  const Belief before = filter.belief();
  for (int i = 0; i < 4; ++i) {
    filter.predict({0.0, 0.0, 1});
  }
  for (const Heading h : kHeadings) {
    EXPECT_EQ(filter.belief().layer(h), before.layer(h));
  }
}

}  // namespace
}  // namespace cmn
