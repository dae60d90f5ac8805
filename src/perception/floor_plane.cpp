// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/perception/floor_plane.hpp"

#include "coarse_map_nav/data/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace cmn {
namespace {

constexpr int kHypotheses = 64;
constexpr std::size_t kMostScored = 500;
constexpr std::size_t kFewestPoints = 60;
constexpr double kLeastShare = 0.25;    ///< of the candidates
constexpr double kLeastSpread_m = 0.1;  ///< standard deviation along the narrow side
constexpr int kRefinements = 3;

/// How far from the plane a floor's point may lie: a depth camera's noise grows with the range.
float tolerance_m(const Eigen::Vector3f& p) { return 0.01F + 0.005F * p.head<2>().norm(); }

bool is_near(const FloorPlane& plane, const Eigen::Vector3f& p) {
  return std::abs(p.z() - plane.at(p.x(), p.y())) < tolerance_m(p);
}

std::optional<FloorPlane> plane_through(const Eigen::Vector3f& p, const Eigen::Vector3f& q,
                                        const Eigen::Vector3f& r) {
  const Eigen::Vector3f normal = (q - p).cross(r - p);
  if (!(normal.z() * normal.z() > 0.5F * normal.squaredNorm())) {  // steep, or no triangle
    return std::nullopt;
  }
  const Eigen::Vector2f slope = -normal.head<2>() / normal.z();
  return FloorPlane{slope, p.z() - slope.dot(p.head<2>())};
}

/// Least squares over the points near `plane`; nothing where they do not tell its slope.
std::optional<FloorPlane> refined(const FloorPlane& plane,
                                  const std::vector<Eigen::Vector3f>& points) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d products = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (const Eigen::Vector3f& p : points) {
    if (is_near(plane, p)) {
      const Eigen::Vector3d row{static_cast<double>(p.x()), static_cast<double>(p.y()), 1.0};
      squares += row * row.transpose();
      products += static_cast<double>(p.z()) * row;
      ++count;
    }
  }
  if (count < kFewestPoints ||
      static_cast<double>(count) < kLeastShare * static_cast<double>(points.size())) {
    return std::nullopt;
  }
  const auto n = static_cast<double>(count);
  const Eigen::Vector2d mean = squares.block<2, 1>(0, 2) / n;
  const Eigen::Matrix2d covariance = squares.topLeftCorner<2, 2>() / n - mean * mean.transpose();
  const double narrow =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>{covariance}.eigenvalues().minCoeff();
  if (!(narrow > kLeastSpread_m * kLeastSpread_m)) {
    return std::nullopt;
  }
  const Eigen::Vector3f solution = squares.ldlt().solve(products).cast<float>();
  return FloorPlane{solution.head<2>(), solution.z()};
}

}  // namespace

FloorEstimator::FloorEstimator(const FloorParams& params)
    : params_{params}, steepest_{static_cast<float>(std::tan(params.tilt_deg * kPi / 180.0))} {}

bool FloorEstimator::is_candidate(const Eigen::Vector3f& p) const {
  const float range_m = p.head<2>().norm();
  return range_m < kReach_m &&
         std::abs(p.z()) < steepest_ * range_m + static_cast<float>(params_.offset_m);
}

bool FloorEstimator::is_plausible(const FloorPlane& plane) const {
  return plane.slope.norm() <= steepest_ &&
         std::abs(static_cast<double>(plane.offset_m)) <= params_.offset_m;
}

FloorPlane FloorEstimator::fit(const std::vector<Eigen::Vector3f>& candidates) {
  source_ = has_last_ ? FloorSource::kLast : FloorSource::kNominal;
  if (candidates.size() < kFewestPoints) {
    return last_;
  }
  const std::size_t every = candidates.size() / kMostScored + 1;
  const auto support_of = [&](const FloorPlane& plane) {
    int support = 0;
    for (std::size_t i = 0; i < candidates.size(); i += every) {
      support += is_near(plane, candidates[i]);
    }
    return support;
  };
  FloorPlane best = last_;
  int best_support = support_of(best);
  std::minstd_rand rng{1};
  for (int i = 0; i < kHypotheses; ++i) {
    const auto& p = candidates[rng() % candidates.size()];
    const auto& q = candidates[rng() % candidates.size()];
    const auto& r = candidates[rng() % candidates.size()];
    const std::optional<FloorPlane> plane = plane_through(p, q, r);
    if (plane && is_plausible(*plane)) {
      const int support = support_of(*plane);
      if (support > best_support) {
        best_support = support;
        best = *plane;
      }
    }
  }
  std::optional<FloorPlane> fitted = best;
  for (int i = 0; i < kRefinements && fitted; ++i) {
    fitted = refined(*fitted, candidates);
  }
  if (fitted && is_plausible(*fitted)) {
    last_ = *fitted;
    has_last_ = true;
    source_ = FloorSource::kSeen;
  }
  return last_;
}

}  // namespace cmn
