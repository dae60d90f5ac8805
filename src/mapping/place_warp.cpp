// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/mapping/place_warp.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/core.hpp>

namespace cmn {
namespace {

constexpr std::size_t kSpline = 6;  ///< places from which on the map may bend

/// The thin-plate kernel r^2 log r.
double kernel(Point2 d) {
  const double r2 = d.x * d.x + d.y * d.y;
  return r2 > 0.0 ? 0.5 * r2 * std::log(r2) : 0.0;
}

}  // namespace

PlaceWarp::PlaceWarp(const std::vector<Place>& places) {
  const std::size_t n = places.size();
  if (n < 3) {
    throw std::runtime_error("a warp needs at least 3 places, here are " + std::to_string(n));
  }
  for (const Place& place : places) {
    middle_ = middle_ + (1.0 / static_cast<double>(n)) * place.world;
  }
  scale_ = 0.0;
  for (const Place& place : places) {
    scale_ = std::max(scale_, norm(place.world - middle_));
  }
  const int knots = n >= kSpline ? static_cast<int>(n) : 0;
  const int rows = knots > 0 ? knots + 3 : static_cast<int>(n);
  cv::Mat_<double> a = cv::Mat_<double>::zeros(rows, knots + 3);
  cv::Mat_<double> b = cv::Mat_<double>::zeros(rows, 2);
  cv::Mat_<double> spread = cv::Mat_<double>::zeros(static_cast<int>(n), 2);
  for (int i = 0; i < static_cast<int>(n); ++i) {
    const Place& place = places[static_cast<std::size_t>(i)];
    const Point2 p = scale_ > 0.0 ? scaled(place.world) : Point2{};
    for (int j = 0; j < knots; ++j) {
      a(i, j) = kernel(p - scaled(places[static_cast<std::size_t>(j)].world));
    }
    a(i, knots) = 1.0;
    a(i, knots + 1) = spread(i, 0) = p.x;
    a(i, knots + 2) = spread(i, 1) = p.y;
    for (int k = 0; knots > 0 && k < 3; ++k) {
      a(knots + k, i) = a(i, knots + k);
    }
    b(i, 0) = place.map.x;
    b(i, 1) = place.map.y;
  }
  cv::Mat_<double> singular;
  cv::SVD::compute(spread, singular, cv::SVD::NO_UV);
  if (!(singular(1) > 1e-6)) {
    throw std::runtime_error("a warp needs places that do not all lie on one line in the world");
  }
  cv::Mat_<double> x;
  if (!cv::solve(a, b, x, knots > 0 ? cv::DECOMP_LU : cv::DECOMP_SVD) ||
      cv::norm(a * x - b, cv::NORM_INF) >
          (knots > 0 ? 1e-6 * (1.0 + cv::norm(b, cv::NORM_INF)) : INFINITY)) {
    throw std::runtime_error("a warp needs places that are distinct in the world");
  }
  const auto row = [&](int i) { return Point2{x(i, 0), x(i, 1)}; };
  for (int i = 0; i < knots; ++i) {
    knots_.push_back(scaled(places[static_cast<std::size_t>(i)].world));
    bend_.push_back(row(i));
  }
  constant_ = row(knots);
  along_x_ = row(knots + 1);
  along_y_ = row(knots + 2);
}

Point2 PlaceWarp::world_to_map(Point2 world) const {
  const Point2 p = scaled(world);
  Point2 map = constant_ + p.x * along_x_ + p.y * along_y_;
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    map = map + kernel(p - knots_[i]) * bend_[i];
  }
  return map;
}

}  // namespace cmn
