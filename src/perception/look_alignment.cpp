// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/look_alignment.hpp"

#include "coarse_map_nav/data/whole_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Dense>
#include <opencv2/imgproc.hpp>

namespace cmn {
namespace {

constexpr std::size_t kLeastPoints = 20;
constexpr std::size_t kMostPoints = 400;
constexpr int kIterations = 6;
constexpr double kBlur = 1.0;  ///< [cells], one sigma: what cells and their corners add to a wall

// Odometry errs by this however little it counts: a controller's last jerk, the grid.
constexpr double kLeastTurn_deg = 0.1;
constexpr double kLeastSlip_m = 0.003;

/// Variance of how well a point fits. Points side by side err together: counted as independent,
/// each says less.
constexpr double kFitVariance = 1.0;

double squared(double value) { return value * value; }

/// A value between the middles of cells, and its slope per cell.
struct Sample {
  double value = 0.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
};

Sample sample(const cv::Mat& image, Point2 p) {
  const int x = whole_below(p.x);
  const int y = whole_below(p.y);
  if (x < 0 || y < 0 || x + 1 >= image.cols || y + 1 >= image.rows) {
    return {};
  }
  const double u = p.x - x;
  const double v = p.y - y;
  const float* const low = image.ptr<float>(y) + x;
  const float* const high = image.ptr<float>(y + 1) + x;
  const auto a = static_cast<double>(low[0]);
  const auto b = static_cast<double>(low[1]);
  const auto c = static_cast<double>(high[0]);
  const auto d = static_cast<double>(high[1]);
  return {(1.0 - v) * ((1.0 - u) * a + u * b) + v * ((1.0 - u) * c + u * d),
          (1.0 - v) * (b - a) + v * (d - c), (1.0 - u) * (c - a) + u * (d - b)};
}

}  // namespace

Pose2 align_look(const std::vector<Point2>& seen, const cv::Mat1b& known, Point2 corner,
                 double resolution, const Pose2& T_map_robot, const Pose2& T_map_last,
                 const AlignmentParams& params) {
  if (seen.size() < kLeastPoints) {
    return T_map_robot;
  }
  cv::Mat1f smooth;
  known.convertTo(smooth, CV_32F, kBlur * std::sqrt(2.0 * kPi));  // such that it is 1 on a wall
  cv::GaussianBlur(smooth, smooth, {}, kBlur);

  const double way_m = norm(T_map_robot.position() - T_map_last.position());
  const double quarters = std::abs(wrap_angle(T_map_robot.yaw - T_map_last.yaw)) / (kPi / 2.0);
  const double turn_variance =
      squared(kPi / 180.0) * (squared(params.drift_per_turn_deg) * quarters +
                              squared(params.drift_per_m_deg) * way_m + squared(kLeastTurn_deg));
  const double slip_variance =
      (squared(params.slip_m) * way_m + squared(kLeastSlip_m)) / squared(resolution);
  const Eigen::Vector3d prior{1.0 / slip_variance, 1.0 / slip_variance, 1.0 / turn_variance};

  const std::size_t every = seen.size() / kMostPoints + 1;
  Pose2 best = T_map_robot;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Point2 expected = (1.0 / resolution) * (T_map_robot.position() - best.position());
    Eigen::Matrix3d information = prior.asDiagonal();
    Eigen::Vector3d pull = prior.cwiseProduct(
        Eigen::Vector3d{expected.x, expected.y, wrap_angle(T_map_robot.yaw - best.yaw)});
    const Point2 origin = (1.0 / resolution) * best.position() - corner;
    const Point2 along = (1.0 / resolution) * turned(Point2{1.0, 0.0}, best.yaw);
    for (std::size_t i = 0; i < seen.size(); i += every) {
      const Point2 arm{along.x * seen[i].x - along.y * seen[i].y,
                       along.y * seen[i].x + along.x * seen[i].y};
      const Sample at = sample(smooth, origin + arm);
      const Eigen::Vector3d slope{at.slope_x, at.slope_y, at.slope_y * arm.x - at.slope_x * arm.y};
      information += slope * slope.transpose() / kFitVariance;
      pull += slope * std::max(0.0, 1.0 - at.value) / kFitVariance;
    }
    const Eigen::Vector3d step = information.ldlt().solve(pull);
    best = {best.x + resolution * step.x(), best.y + resolution * step.y(),
            wrap_angle(best.yaw + step.z())};
  }
  return best;
}

}  // namespace cmn
