// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/look_alignment.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace cmn {
namespace {

constexpr double kDegree = kPi / 180.0;
constexpr double kCell_m = 0.05;
constexpr int kSize = 200;
const Point2 kCorner = middle_of({-100, -100});

/// The walls of a room of 4 x 3 m about the origin, a point every 5 cm.
std::vector<Point2> walls() {
  std::vector<Point2> points;
  for (double x = -2.0; x <= 2.0; x += 0.05) {
    points.push_back({x, -1.5});
    points.push_back({x, 1.5});
  }
  for (double y = -1.5; y <= 1.5; y += 0.05) {
    points.push_back({-2.0, y});
    points.push_back({2.0, y});
  }
  return points;
}

cv::Mat1b cells_of(const std::vector<Point2>& points) {
  cv::Mat1b cells = cv::Mat1b::zeros(kSize, kSize);
  for (const Point2 p : points) {
    cells(static_cast<int>(std::floor(p.y / kCell_m)) + kSize / 2,
          static_cast<int>(std::floor(p.x / kCell_m)) + kSize / 2) = 1;
  }
  return cells;
}

std::vector<Point2> seen_from(const Pose2& T_map_robot, const std::vector<Point2>& points) {
  std::vector<Point2> seen;
  for (const Point2 p : points) {
    seen.push_back(inverse(T_map_robot) * p);
  }
  return seen;
}

TEST(AlignLook, FindsWhereItWasTakenFrom) {
  const Pose2 T_map_last{0.2, -0.3, 0.4};
  for (const double error_deg : {-3.0, -1.0, 0.2, 2.0}) {
    for (const Point2 slip : {Point2{0.0, 0.0}, Point2{0.02, -0.01}, Point2{-0.015, 0.02}}) {
      SCOPED_TRACE(std::to_string(error_deg) + " degrees");
      const Pose2 truth = T_map_last * Pose2{0.15, 0.0, kPi / 2.0};
      const Pose2 by_odometry{truth.x + slip.x, truth.y + slip.y, truth.yaw + error_deg * kDegree};
      const Pose2 found = align_look(seen_from(truth, walls()), cells_of(walls()), kCorner, kCell_m,
                                     by_odometry, T_map_last, {});
      // A part of odometry's error stays, by its prior, and what the cells hide.
      EXPECT_NEAR(wrap_angle(found.yaw - truth.yaw) / kDegree, 0.0,
                  0.3 + 0.15 * std::abs(error_deg));
      EXPECT_LT(norm(found.position() - truth.position()), 0.025);
    }
  }
}

TEST(AlignLook, AlongABareWallOdometryIsAllThereIs) {
  std::vector<Point2> wall;
  for (double x = -4.0; x <= 4.0; x += 0.05) {
    wall.push_back({x, 1.0});
  }
  std::vector<Point2> near;
  for (const Point2 p : wall) {
    if (std::abs(p.x) < 2.0) {
      near.push_back(p);
    }
  }
  const Pose2 by_odometry{0.3, 0.02, 1.0 * kDegree};
  const Pose2 found =
      align_look(near, cells_of(wall), kCorner, kCell_m, by_odometry, {0.0, 0.0, 0.5}, {});
  EXPECT_NEAR(found.yaw / kDegree, 0.0, 0.5);
  EXPECT_NEAR(found.y, 0.0, kCell_m / 2.0) << "at most what a cell hides";
  EXPECT_NEAR(found.x, by_odometry.x, 0.01);
}

TEST(AlignLook, WhereNothingIsKnownOrHardlyAnythingSeenOdometryIsTaken) {
  const Pose2 by_odometry{1.0, 0.5, 0.7};
  const auto off = [&](const std::vector<Point2>& seen, const cv::Mat1b& known) {
    const Pose2 found = align_look(seen, known, kCorner, kCell_m, by_odometry, {}, {});
    return norm(found.position() - by_odometry.position()) + std::abs(found.yaw - by_odometry.yaw);
  };
  EXPECT_EQ(off(walls(), cells_of({})), 0.0);
  EXPECT_EQ(off({{1.0, 0.0}, {2.0, 0.0}}, cells_of(walls())), 0.0);
  EXPECT_EQ(off({}, cells_of(walls())), 0.0);
  // And what is seen where the map does not reach says nothing.
  EXPECT_EQ(off(seen_from({100.0, 0.0, 0.0}, walls()), cells_of(walls())), 0.0);
}

TEST(AlignLook, TrustsAnOdometryThatDoesNotErr) {
  AlignmentParams exact;
  exact.drift_per_turn_deg = exact.drift_per_m_deg = exact.slip_m = 0.0;
  const Pose2 truth{0.0, 0.0, 0.0};
  const Pose2 by_odometry{0.0, 0.0, 2.0 * kDegree};
  const auto found = [&](const AlignmentParams& params) {
    return align_look(seen_from(truth, walls()), cells_of(walls()), kCorner, kCell_m, by_odometry,
                      {0.0, 0.0, -kPi / 2.0}, params);
  };
  EXPECT_GT(std::abs(found(exact).yaw), std::abs(found({}).yaw));
}

}  // namespace
}  // namespace cmn
