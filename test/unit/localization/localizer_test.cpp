// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/localizer.hpp"

#include "coarse_map_nav/localization/belief_filter.hpp"

#include <cmath>
#include <memory>
#include <numeric>
#include <string>

#include "ascii_map.hpp"
#include <gtest/gtest.h>

namespace cmn {
namespace {

/// What holds for every filter behind the seam.
class EveryFilter : public testing::TestWithParam<std::string> {
 protected:
  static CoarseMap drawing() {
    return ascii_map({"############",  //
                      "#..........#",  //
                      "#.####.###.#",  //
                      "#.#....#...#",  //
                      "#..........#",  //
                      "############"},
                     0.4, {-1.0, 2.0, kPi / 2.0});
  }
  std::unique_ptr<Localizer> make() const {
    LocalizationParams params;
    params.filter = GetParam();
    return make_localizer(drawing(), params);
  }
  /// Nothing is known: only the motion counts.
  static LocalOccupancy nothing_seen() { return LocalOccupancy{9, 0.2}; }
  static double total(const Localizer& localizer) {
    const Grid<double> p = marginal(localizer.localization().belief);
    return std::accumulate(p.values().begin(), p.values().end(), 0.0);
  }
};

TEST_P(EveryFilter, StartsNearAGivenPoseWhateverTheOdometrySays) {
  const std::unique_ptr<Localizer> localizer = make();
  const CoarseMap map = drawing();
  localizer->update(nothing_seen(), {3.0, 1.0, 0.4});  // it has been under way for long
  for (const double odom_yaw : {0.0, 1.6, -1.5, 3.1}) {
    for (const Heading heading : kHeadings) {
      SCOPED_TRACE(std::to_string(odom_yaw) + " " + std::to_string(index(heading)));
      const Point2 p = map.center_of({5, 2});
      ASSERT_TRUE(localizer->reset_near({p.x, p.y, yaw(heading) + map.T_map_grid().yaw}, 0.1, 0.1));
      localizer->update(nothing_seen(), {7.0, -2.0, odom_yaw});
      const Localization at = localizer->localization();
      EXPECT_EQ(at.estimate.heading, heading);
      EXPECT_LT(norm(at.position_cells - middle_of({5, 2})), 1.0);
      EXPECT_NEAR(wrap_angle(at.yaw_rad - yaw(heading)), 0.0, 0.2);
      EXPECT_NEAR(total(*localizer), 1.0, 1e-6);
      const Pose2 pose = pose_in_map(map, at);
      EXPECT_LT(norm(pose.position() - p), 0.4);
      EXPECT_NEAR(wrap_angle(pose.yaw - at.yaw_rad), kPi / 2.0, 1e-9);
    }
  }
}

TEST_P(EveryFilter, RefusesAPoseFromAllFreeCellsAndKeepsItsBelief) {
  const std::unique_ptr<Localizer> localizer = make();
  const double before = entropy(localizer->localization().belief);
  EXPECT_FALSE(localizer->reset_near({900.0, 0.0, 0.0}, 0.2, 0.1));
  EXPECT_EQ(entropy(localizer->localization().belief), before);
}

TEST_P(EveryFilter, ForgetsThePlaceOnReset) {
  const std::unique_ptr<Localizer> localizer = make();
  const double before = entropy(localizer->localization().belief);
  const Point2 p = drawing().center_of({5, 2});
  ASSERT_TRUE(localizer->reset_near({p.x, p.y, 0.0}, 0.1, 0.1));
  EXPECT_LT(entropy(localizer->localization().belief), before - 1.0);
  localizer->reset();
  EXPECT_NEAR(entropy(localizer->localization().belief), before, 0.2);
  EXPECT_TRUE(is_same_drawing(localizer->map(), drawing()));
}

INSTANTIATE_TEST_SUITE_P(Filters, EveryFilter, testing::Values("discrete", "particle", "scaled"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace cmn
