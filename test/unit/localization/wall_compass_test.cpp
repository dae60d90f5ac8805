// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/wall_compass.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kDegree = kPi / 180.0;

/// What is seen in a hall of which `depth` tells how far a point lies within its walls [m] by one
/// who stands in it with the axes of the hall at `hall_yaw_rad` from his own.
LocalOccupancy view(const std::function<double(Point2)>& depth, double hall_yaw_rad) {
  LocalOccupancy seen{120, 0.05};
  for (int iy = 0; iy < seen.size; ++iy) {
    for (int ix = 0; ix < seen.size; ++ix) {
      const Point2 p{(ix + 0.5 - 60) * seen.resolution, (iy + 0.5 - 60) * seen.resolution};
      const double within = depth(turned(p, -hall_yaw_rad));
      seen.occupancy[seen.index_of(ix, iy)] = within <= 0.0 ? 1.0F : 0.0F;
      seen.confidence[seen.index_of(ix, iy)] = within > -0.15 ? 1.0F : 0.0F;
    }
  }
  return seen;
}

double depth_of_room(Point2 p) { return std::min({p.x + 1.2, 2.1 - p.x, p.y + 1.4, 0.9 - p.y}); }

double depth_of_round_hall(Point2 p) { return 2.2 - norm(p); }

/// After so many looks of a robot that turns as it goes, the odometry being wrong by `error_rad`.
double axes_after(WallCompass& compass, const std::function<double(Point2)>& depth,
                  double error_rad, int looks) {
  for (int i = 0; i < looks; ++i) {
    const double yaw_rad = 0.7 * i;
    compass.look(view(depth, error_rad - yaw_rad), {0.0, 0.0, yaw_rad});
  }
  return compass.axes_yaw_rad();
}

TEST(WallCompass, FindsTheAxesOfARoom) {
  for (const double error_deg : {-6.0, -4.5, -1.0, 0.0, 3.0, 6.0}) {
    SCOPED_TRACE("error " + std::to_string(error_deg));
    WallCompass compass{WallCompassParams{}};
    EXPECT_NEAR(axes_after(compass, depth_of_room, error_deg * kDegree, 25) / kDegree, error_deg,
                0.5);
  }
}

TEST(WallCompass, FollowsTheAxesPastAQuarterTurn) {
  WallCompass compass{WallCompassParams{}};
  for (int i = 0; i < 250; ++i) {  // the odometry drifts by half a degree a look
    const double error_rad = 0.5 * kDegree * i;
    compass.look(view(depth_of_room, error_rad - 0.7 * i), {0.0, 0.0, 0.7 * i});
    ASSERT_NEAR(compass.axes_yaw_rad() / kDegree, error_rad / kDegree, 4.0) << i;
  }
}

TEST(WallCompass, KeepsUpWithTurnsThatNobodyTellsOf) {
  // From look to look the robot turns round once, and comes out 2 degrees off.
  WallCompassParams params;
  for (const double drift_deg : {0.0, 2.0}) {
    params.drift_per_look_deg = drift_deg;
    WallCompass compass{params};
    double worst_deg = 0.0;
    for (int i = 0; i < 20; ++i) {
      compass.look(view(depth_of_room, 2.0 * kDegree * i), {0.15 * i, 0.0, 0.0});
      worst_deg = std::max(worst_deg, std::abs(compass.axes_yaw_rad() / kDegree - 2.0 * i));
    }
    EXPECT_EQ(worst_deg<3.0, drift_deg> 0.0) << worst_deg;
  }
}

TEST(WallCompass, KeepsUpWithAnOdometryThatLosesPartOfEachTurn) {
  // A quarter turn to the left again and again, of which it says so much less.
  for (const double lost : {0.05, -0.05}) {
    SCOPED_TRACE("lost " + std::to_string(lost));
    WallCompassParams params;
    params.drift_per_turn_deg = 4.5;
    WallCompass compass{params};
    for (int i = 0; i < 40; ++i) {
      const double true_yaw_rad = i * kPi / 2.0 + 0.2;
      const double yaw_rad = (1.0 - lost) * i * kPi / 2.0 + 0.2;
      compass.look(view(depth_of_room, -true_yaw_rad), {0.0, 0.0, yaw_rad});
      const double off_rad =
          std::remainder(compass.axes_yaw_rad() - (yaw_rad - true_yaw_rad), kPi / 2.0);
      ASSERT_NEAR(off_rad / kDegree, 0.0, 3.0) << i;
    }
    EXPECT_NEAR(compass.axes_yaw_rad() / kDegree, -lost * 39 * 90.0, 3.0);
  }
}

/// Nothing but a row of cupboards in an open hall, 14 degrees askew.
double depth_beside_cupboards(Point2 p) { return 2.0 - turned(p, -14.0 * kDegree).y; }

TEST(WallCompass, TakesNothingAskewForAWallOnceItKnowsThem) {
  WallCompass compass{WallCompassParams{}};
  axes_after(compass, depth_of_room, 2.0 * kDegree, 10);
  const double known_rad = compass.axes_yaw_rad();
  for (int i = 0; i < 20; ++i) {  // along them
    compass.look(view(depth_beside_cupboards, 2.0 * kDegree), {0.15 * i, 0.0, 0.0});
  }
  EXPECT_NEAR(compass.axes_yaw_rad() / kDegree, known_rad / kDegree, 0.5);
}

TEST(WallCompass, FindsAnyAxesOnceItIsLost) {
  for (const double error_deg : {-40.0, -20.0, 13.0, 35.0}) {
    SCOPED_TRACE("error " + std::to_string(error_deg));
    WallCompass compass{WallCompassParams{}};
    axes_after(compass, depth_of_room, 0.0, 10);
    compass.lose();
    EXPECT_NEAR(axes_after(compass, depth_of_room, error_deg * kDegree, 25) / kDegree, error_deg,
                0.7);
  }
}

TEST(WallCompass, FollowsTheDriftThatPerceptionTellsOf) {
  // In a round hall nothing else tells, and in a room it does not contradict.
  for (const auto& depth : {depth_of_room, depth_of_round_hall}) {
    WallCompass compass{WallCompassParams{}};
    for (int i = 0; i < 100; ++i) {
      const double drift_rad = 2.0 + 2.0 * kDegree * i;  // since whenever
      LocalOccupancy seen = view(depth, 2.0 * kDegree * i);
      seen.heading_drift = HeadingDrift{wrap_angle(drift_rad), 7.0};
      compass.look(seen, {0.15 * i, 0.0, 0.0});
      ASSERT_NEAR(compass.axes_yaw_rad() / kDegree, 2.0 * i, 1.0) << i;
    }
    // Perception was started anew, and tells of the drift since then.
    LocalOccupancy seen = view(depth, 198.0 * kDegree);
    seen.heading_drift = HeadingDrift{0.0, 107.0};
    compass.look(seen, {15.0, 0.0, 0.0});
    EXPECT_NEAR(compass.axes_yaw_rad() / kDegree, 198.0, 1.0);
  }
}

TEST(WallCompass, FindsNoAxesInARoundHall) {
  WallCompass compass{WallCompassParams{}};
  EXPECT_EQ(axes_after(compass, depth_of_round_hall, 5.0 * kDegree, 25), 0.0);
}

TEST(WallCompass, FindsNoAxesWhereLittleIsSeen) {
  WallCompass compass{WallCompassParams{}};
  const auto corner = [](Point2 p) { return std::max(2.7 - p.x, 2.7 - p.y); };
  EXPECT_EQ(axes_after(compass, corner, 5.0 * kDegree, 5), 0.0);
  compass.look(LocalOccupancy{120, 0.05}, {0.0, 0.0, 0.1});
  EXPECT_EQ(compass.axes_yaw_rad(), 0.0);
}

TEST(WallCompass, DisabledItLeavesTheOdometryAlone) {
  WallCompassParams params;
  params.enabled = false;
  WallCompass compass{params};
  EXPECT_EQ(axes_after(compass, depth_of_room, 5.0 * kDegree, 5), 0.0);
}

}  // namespace
}  // namespace cmn
