// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What holds for the whole-range filter on any map, whatever it sees and however it is moved.
#include "coarse_map_nav/localization/scale_filter.hpp"

#include <cmath>
#include <string>

#include "random_case.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

/// Free ground with something here and there, part of it unseen.
LocalOccupancy random_look(std::mt19937_64& rng) {
  LocalOccupancy seen{40, 0.2};
  const double share = 0.2 * draw_uniform(rng);
  const double unseen = draw_uniform(rng) < 0.2 ? 1.0 : 0.1 * draw_uniform(rng);
  for (std::size_t i = 0; i < seen.cell_count(); ++i) {
    seen.occupancy[i] = draw_uniform(rng) < share ? 1.0F : 0.0F;
    seen.confidence[i] = draw_uniform(rng) < unseen ? 0.0F : 1.0F;
  }
  return seen;
}

/// A step or a turn, at times a leap.
Pose2 random_motion(std::mt19937_64& rng) {
  const double kind = draw_uniform(rng);
  return kind < 0.5   ? Pose2{0.3 * draw_uniform(rng), 0.0, 0.0}
         : kind < 0.9 ? Pose2{0.0, 0.0, kPi / 2.0 * (1.0 - 2.0 * draw_uniform(rng))}
                      : Pose2{4.0 * draw_normal(rng), 4.0 * draw_normal(rng), draw_normal(rng)};
}

ScaleFilterParams random_params(std::mt19937_64& rng) {
  ScaleFilterParams params;
  params.scales = 1 + static_cast<int>(draw_index(rng, 4));
  params.carried_share = draw_uniform(rng) < 0.3 ? 0.2 : 1.0;  // looks at random seldom agree
  params.part_m = 0.12 + 0.4 * draw_uniform(rng);
  params.headings = 4 * (1 + static_cast<int>(draw_index(rng, 3)));
  params.blocked_share = draw_uniform(rng) < 0.3 ? 0.0 : 0.3;
  params.rim_penalty = draw_uniform(rng) < 0.3 ? 0.0 : 0.3;
  return params;
}

TEST(ScaleFilterProperty, AnySequenceKeepsUnitMass) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const CoarseMap map = random_map(rng, 4 + static_cast<int>(draw_index(rng, 8)), 7);
    ScaleFilter filter{map, random_params(rng), 0.5};
    Pose2 T_odom_robot{1.0, 2.0, 0.3};
    for (int i = 0; i < 12; ++i) {
      filter.update(random_look(rng), T_odom_robot);
      T_odom_robot = T_odom_robot * random_motion(rng);
      const Localization at = filter.localization();
      double sum = 0.0;
      for (const Heading h : kHeadings) {
        for (const double p : at.belief.layer(h)) {
          ASSERT_GE(p, 0.0) << "look " << i;  // nor NaN
          sum += p;
        }
      }
      ASSERT_NEAR(sum, 1.0, 1e-5) << "look " << i;
      ASSERT_NEAR(total(at.belief), 1.0, 1e-5) << "look " << i;  // none of it in the padding
      double scales = 0.0;
      for (const double p : filter.scale_marginal()) {
        ASSERT_GE(p, 0.0) << "look " << i;
        scales += p;
      }
      ASSERT_NEAR(scales, 1.0, 1e-5) << "look " << i;
      ASSERT_TRUE(std::isfinite(at.position_cells.x) && std::isfinite(at.position_cells.y));
      ASSERT_TRUE(std::isfinite(at.scale) && std::isfinite(filter.fit()));
      ASSERT_GE(at.confidence, 0.0);
      ASSERT_LE(at.confidence, 1.0 + 1e-5);
    }
  }
}

TEST(ScaleFilterProperty, TurningTheMapTurnsTheBelief) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 rng{seed};
    const CoarseMap map = random_map(rng, 8, 6);
    const ScaleFilterParams params = random_params(rng);
    ScaleFilter filter{map, params, 0.5};
    ScaleFilter left{turned_left(map), params, 0.5};
    Pose2 T_odom_robot{0.0, 0.0, 0.1};
    for (int i = 0; i < 10; ++i) {
      const LocalOccupancy seen = random_look(rng);
      ASSERT_EQ(filter.update(seen, T_odom_robot), left.update(seen, T_odom_robot));
      T_odom_robot = T_odom_robot * random_motion(rng);
      for (const Heading h : kHeadings) {
        for (int y = 0; y < map.height(); ++y) {
          for (int x = 0; x < map.width(); ++x) {
            ASSERT_NEAR(left.localization().belief(turned(h, 1), {map.height() - 1 - y, x}),
                        filter.localization().belief(h, {x, y}), 1e-4)
                << "look " << i;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace cmn
